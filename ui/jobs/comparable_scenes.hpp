#pragma once

#include "core/mechanics/model.hpp"
#include "core/scene/scene.hpp"

namespace pliant::jobs {

/// Whether both scenes pose the same problem but for the values of the parameters of `model`, which is that of one of
/// them: whether motions of one can be predicted from motions of the other.
bool areComparable(const scene::Scene& a, const scene::Scene& b, const mechanics::Model& model);

}  // namespace pliant::jobs
