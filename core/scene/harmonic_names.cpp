#include "core/scene/harmonic_names.hpp"

#include <array>

namespace pliant::scene {

namespace {

constexpr std::array<std::string_view, 6> kindNames{
    "regular", "fold", "peak", "branch_point", "period_doubling", "neimark_sacker"};
constexpr std::array<std::string_view, 3> stateNames{"unknown", "stable", "unstable"};

/// The place of a name among others, 0 if it is not there.
template <std::size_t N>
std::size_t placeOf(std::string_view name, const std::array<std::string_view, N>& names) {
  for (std::size_t i = 0; i < N; ++i)
    if (names[i] == name) return i;
  return 0;
}

}  // namespace

std::string_view nameOf(harmonic::PointKind kind) { return kindNames[static_cast<std::size_t>(kind)]; }
std::string_view nameOf(harmonic::StabilityState state) { return stateNames[static_cast<std::size_t>(state)]; }

harmonic::PointKind pointKindOf(std::string_view name) {
  return static_cast<harmonic::PointKind>(placeOf(name, kindNames));
}
harmonic::StabilityState stabilityStateOf(std::string_view name) {
  return static_cast<harmonic::StabilityState>(placeOf(name, stateNames));
}

}  // namespace pliant::scene
