#pragma once

#include "core/base/parameter_spec.hpp"

/// The part of the file format that declares elastic bodies.
namespace pliant::scene {

inline constexpr int largestMesh = 1'000'000;  ///< nodes

base::ParameterSpec nodeIndex();
base::ParameterSpec materialSpecs();
base::ParameterSpec elementSpecs();

}  // namespace pliant::scene
