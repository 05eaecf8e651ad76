#include "core/math/student_t.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace pliant::math {

namespace {

/// The fraction 1 / (1 + d₁ / (1 + d₂ / (1 + ...))) by the method of Lentz, as modified by Thompson and Barnett (1986).
double betaFraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  constexpr int mostTerms = 100'000;
  const auto away = [](double value) { return std::abs(value) < tiny ? tiny : value; };
  double numerator = 1, denominator = 0, value = 1;
  for (int term = 0; term < mostTerms; ++term) {
    const double m = term / 2;
    double d = 1;
    if (term > 0)
      d = term % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                        : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    denominator = 1 / away(1 + d * denominator);
    numerator = away(1 + d / numerator);
    const double factor = numerator * denominator;
    value *= factor;
    if (term > 1 && std::abs(factor - 1) < std::numeric_limits<double>::epsilon()) break;
  }
  return value - 1;
}

}  // namespace

double incompleteBeta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incompleteBeta(b, a, 1 - x);  // where the fraction converges faster
  const double logFactor = std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
  return std::exp(logFactor) / a * betaFraction(a, b, x);
}

double studentProbability(double t, double degreesOfFreedom) {
  const double square = t * t;
  // The smaller of two complementary arguments keeps its digits.
  const double tails = square < degreesOfFreedom
                           ? 1 - incompleteBeta(0.5, degreesOfFreedom / 2, square / (degreesOfFreedom + square))
                           : incompleteBeta(degreesOfFreedom / 2, 0.5, degreesOfFreedom / (degreesOfFreedom + square));
  return t < 0 ? tails / 2 : 1 - tails / 2;
}

double studentQuantile(double probability, double degreesOfFreedom) {
  if (!(probability > 0 && probability < 1 && degreesOfFreedom > 0))
    throw std::invalid_argument("a probability that is not between 0 and 1, or no degrees of freedom");
  if (probability == 0.5) return 0;
  if (probability > 0.5) return -studentQuantile(1 - probability, degreesOfFreedom);
  double low = -1;
  while (studentProbability(low, degreesOfFreedom) > probability) low *= 2;
  double high = 0;
  for (int halving = 0; halving < 200 && low < high; ++halving) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (studentProbability(middle, degreesOfFreedom) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace pliant::math
