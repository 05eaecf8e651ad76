#pragma once

#include <string_view>

#include "core/harmonic/response_point.hpp"

namespace pliant::scene {

/// What kinds of points and states of stability are called in result files; unknown names are read as `regular` and
/// `unknown`.
std::string_view nameOf(harmonic::PointKind kind);
std::string_view nameOf(harmonic::StabilityState state);
harmonic::PointKind pointKindOf(std::string_view name);
harmonic::StabilityState stabilityStateOf(std::string_view name);

}  // namespace pliant::scene
