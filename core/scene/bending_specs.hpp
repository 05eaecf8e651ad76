#pragma once

#include <vector>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

/// Studies of finite patches of interlocking elements.
std::vector<base::ParameterSpec> bendingStudySpecs();

}  // namespace pliant::scene
