#include "core/harmonic/response_point.hpp"

#include <algorithm>
#include <cmath>

namespace pliant::harmonic {

std::complex<double> criticalMultiplier(const ResponsePoint& point) {
  const auto& multipliers = point.stability.multipliers;
  if (multipliers.empty()) return 0;
  if (point.kind == PointKind::regular || point.kind == PointKind::peak) return multipliers.front();
  return *std::min_element(multipliers.begin(), multipliers.end(), [](auto a, auto b) {
    return std::abs(std::log(std::abs(a))) < std::abs(std::log(std::abs(b)));
  });
}

}  // namespace pliant::harmonic
