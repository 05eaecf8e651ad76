#pragma once

namespace pliant::math {

/// The regularised incomplete beta function I_x(a, b) for a, b > 0 and x in [0, 1]: its continued fraction (Abramowitz
/// and Stegun 26.5.8).
double incompleteBeta(double a, double b, double x);

/// The probability that a variable with Student's distribution of `degreesOfFreedom` > 0 is at most t.
double studentProbability(double t, double degreesOfFreedom);

/// The t that it stays below with this probability, between 0 and 1.
double studentQuantile(double probability, double degreesOfFreedom);

}  // namespace pliant::math
