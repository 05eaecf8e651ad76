#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/cloth/stretch_limit.hpp"

namespace pliant::cloth {

/// Directions in [0, π), ascending: `count` equally spaced ones, and as dense in each piece of a curve, however short,
/// that it looks smooth from one to the next.
std::vector<double> samplingAngles(const StretchLimit& limit, int count);

/// The largest value of a function on [begin, end] that has one maximum there, by golden section.
template <class Function>
double largestBetween(double begin, double end, const Function& function) {
  constexpr double golden = 1 / std::numbers::phi;
  double left = end - golden * (end - begin), right = begin + golden * (end - begin);
  double atLeft = function(left), atRight = function(right);
  double largest = std::max(atLeft, atRight);
  // Next to a smooth maximum the error is of second order: at 1e-4 of a neighbourhood already small, here 1e-13.
  for (int i = 0; i < 32; ++i) {
    if (atLeft > atRight) {
      end = right;
      right = left;
      atRight = atLeft;
      left = end - golden * (end - begin);
      atLeft = function(left);
    } else {
      begin = left;
      left = right;
      atLeft = atRight;
      right = begin + golden * (end - begin);
      atRight = function(right);
    }
    largest = std::max({largest, atLeft, atRight});
  }
  return largest;
}

/// The largest value over all directions of a function with period π whose values at some of them are known. Between
/// these it looks around each that is above its neighbours and not below the highest by more than `slack`.
template <class Function>
double largestOverDirections(const std::vector<double>& angles, const std::vector<double>& values, double slack,
                             const Function& function) {
  const std::size_t count = angles.size();
  const double highest = *std::max_element(values.begin(), values.end());
  double largest = highest;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count, after = (i + 1) % count;
    if (values[i] < values[before] || values[i] < values[after] || values[i] < highest - slack) continue;
    // A maximum in between is hardly higher above this than this above its neighbours, which may be but rounding.
    if (values[i] - std::min(values[before], values[after]) <= 1e-13 * std::abs(values[i])) continue;
    const double begin = i > 0 ? angles[before] : angles[before] - std::numbers::pi;
    const double end = i + 1 < count ? angles[after] : angles[after] + std::numbers::pi;
    largest = std::max(largest, largestBetween(begin, end, function));
  }
  return largest;
}

template <class Function>
double largestOverDirections(const std::vector<double>& angles, const Function& function) {
  std::vector<double> values(angles.size());
  std::transform(angles.begin(), angles.end(), values.begin(), function);
  return largestOverDirections(angles, values, std::numeric_limits<double>::infinity(), function);
}

}  // namespace pliant::cloth
