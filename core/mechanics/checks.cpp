#include "core/mechanics/checks.hpp"

#include <cmath>
#include <sstream>

#include "core/base/error.hpp"

namespace pliant::mechanics {

namespace {

std::string text(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

[[noreturn]] void refuse(const std::string& sentence) { throw base::InputError("", sentence); }

}  // namespace

void requireFinite(double value, const std::string& what) {
  if (!std::isfinite(value)) refuse(what + " must be a finite number, but is " + text(value));
}

void requireNotNegative(double value, const std::string& what) {
  if (!std::isfinite(value) || value < 0)
    refuse(what + " must be a finite number of at least 0, but is " + text(value));
}

void requirePositive(double value, const std::string& what) {
  if (!std::isfinite(value) || value <= 0) refuse(what + " must be a finite number above 0, but is " + text(value));
}

void requireVector(const Vector& value, int size, const std::string& what) {
  if (value.size() != size)
    refuse(what + " must have " + std::to_string(size) + " components, but has " + std::to_string(value.size()));
  for (int i = 0; i < size; ++i) requireFinite(value[i], what);
}

void requireDimension(int dimension, const std::string& what, int least) {
  if (dimension < least || dimension > 3)
    refuse(what + " must have " + std::to_string(least) + " to 3 dimensions, but has " + std::to_string(dimension));
}

void requireNodes(std::span<const int> nodes, int nodeCount, const std::string& what) {
  for (const int node : nodes)
    if (node < 0 || node >= nodeCount)
      refuse(what + " names node " + std::to_string(node) + ", but there are " + std::to_string(nodeCount) + " nodes");
}

void requireFactors(std::span<const double> factors, std::size_t elementCount) {
  if (!factors.empty() && factors.size() != elementCount)
    refuse("there must be a factor for each of the " + std::to_string(elementCount) + " elements, but there are " +
           std::to_string(factors.size()));
  for (std::size_t e = 0; e < factors.size(); ++e)
    requirePositive(factors[e], "the factor of element " + std::to_string(e));
}

void requireSpringLaw(const SpringLaw& law) {
  if (law.coefficients.empty()) refuse("a spring must have at least one stiffness coefficient");
  for (const double c : law.coefficients) requireFinite(c, "a spring's stiffness coefficient");
}

void requireSignal(const PeriodicSignal& signal, const std::string& what) {
  for (const PeriodicSignal::Term& term : signal.terms) {
    if (term.order < 0)
      refuse(what + " must have terms of an order of at least 0, but one has " + std::to_string(term.order));
    requireFinite(term.amplitude, what + "'s amplitude");
    requireFinite(term.phase, what + "'s phase");
  }
}

}  // namespace pliant::mechanics
