#pragma once

#include <vector>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

/// The keys of a study of the type "design_space", besides those of every harmonic-balance study.
std::vector<base::ParameterSpec> designSpaceKeys();

}  // namespace pliant::scene
