#pragma once

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

/// The key "constraints" of a study of the type "design".
base::ParameterSpec designConstraints();

}  // namespace pliant::scene
