#pragma once

#include "core/scene/parts_export.hpp"

namespace pliant::scene {

/// The links of a plane mechanism as plates; none if there are no links. Links that a rigid angle joins are one plate:
/// the union of their rounded hulls, and of arms to where springs are attached beside them. There is a hole at each
/// joint, save where rigid angles alone meet and no mass sits, and at each place where a spring is attached to a link.
/// Plates that come nearer to one another than the clearance, at rest or during the motion, lie in different layers,
/// as few as can be, and where that is possible no plate lies between two others in the way of the pin that joins
/// them; with `flat` they lie side by side instead. Throws base::InputError: links in space, holes that run into one
/// another.
std::vector<Part> linkPlates(const PartsSource& source, const PartsRequest& request, std::vector<std::string>& remarks);

}  // namespace pliant::scene
