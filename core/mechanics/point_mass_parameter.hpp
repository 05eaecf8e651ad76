#pragma once

#include <memory>

#include "core/mechanics/design_parameter.hpp"

namespace pliant::mechanics {

/// The mass of `Model::pointMasses[index]` (put on each of its nodes) as a design parameter.
std::shared_ptr<const DesignParameter> makePointMassParameter(int index);

}  // namespace pliant::mechanics
