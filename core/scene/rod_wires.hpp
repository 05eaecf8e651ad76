#pragma once

#include "core/scene/parts_export.hpp"

namespace pliant::scene {

/// The rods of a scene as wires of their sections, with round joints and ends; none if there are no rods, or
/// once cancelled. At nodes that bear a point mass there is a socket for a ball of that mass (request.density) with the
/// clearance around it: a part of a spherical shell that reaches 20° beyond the ball's middle, so that it snaps in,
/// open where the wires leave most room. Tubes are made solid, and the edges of flat rods round with an eighth of their
/// smaller side. Throws base::InputError: flat rods that have moved, a wire that balls cut off.
std::vector<Part> rodWires(const PartsSource& source, const PartsRequest& request, base::ExecutionContext& context,
                           std::vector<std::string>& remarks);

/// The diameter of a ball of a mass [kg] and density [kg/m³], in [m].
double ballDiameter(double mass, double density);

}  // namespace pliant::scene
