#pragma once

#include <memory>
#include <string>

#include "core/mechanics/design_parameter.hpp"

namespace pliant::mechanics {

/// The mass of `Model::pointMasses[index]` (put on each of its nodes) as a design parameter called `name`, at
/// "/point_masses/INDEX/mass" of the scene.
std::shared_ptr<const DesignParameter> makePointMassParameter(int index, std::string name);

}  // namespace pliant::mechanics
