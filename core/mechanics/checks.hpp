#pragma once

#include <span>
#include <string>

#include "core/mechanics/model.hpp"
#include "core/mechanics/spring.hpp"

namespace pliant::mechanics {

/// Checks of user input. Each throws base::InputError (location empty) with one sentence that starts with `what`,
/// such as "the spring's rest length".
void requireFinite(double value, const std::string& what);
void requireNotNegative(double value, const std::string& what);
void requirePositive(double value, const std::string& what);
/// Finite, and of the given size.
void requireVector(const Vector& value, int size, const std::string& what);
/// From `least` to 3.
void requireDimension(int dimension, const std::string& what, int least = 1);
/// Every index in [0, nodeCount).
void requireNodes(std::span<const int> nodes, int nodeCount, const std::string& what);
/// None, or one for each element, above 0.
void requireFactors(std::span<const double> factors, std::size_t elementCount);
/// At least one coefficient, all finite.
void requireSpringLaw(const SpringLaw& law);
/// Orders of at least 0, finite amplitudes and phases.
void requireSignal(const PeriodicSignal& signal, const std::string& what);

}  // namespace pliant::mechanics
