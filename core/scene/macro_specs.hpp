#pragma once

#include <vector>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

/// Studies of large pieces of interlocking materials.
std::vector<base::ParameterSpec> macroStudySpecs();

}  // namespace pliant::scene
