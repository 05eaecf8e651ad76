#pragma once

#include <vector>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

/// The keys of a study of the type "element_design", besides those of every test of limits.
std::vector<base::ParameterSpec> elementDesignKeys();

}  // namespace pliant::scene
