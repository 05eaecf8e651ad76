#pragma once

#include <vector>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

/// The options of every kind of study: an object each, whose `key` is the study's "type".
const std::vector<base::ParameterSpec>& studySpecs();

}  // namespace pliant::scene
