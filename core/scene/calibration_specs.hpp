#pragma once

#include <vector>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

/// The keys of a study of the type "calibration", besides those of every harmonic-balance study.
std::vector<base::ParameterSpec> calibrationKeys();

}  // namespace pliant::scene
