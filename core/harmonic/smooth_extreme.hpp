#pragma once

#include <Eigen/Core>
#include <cmath>

namespace pliant::harmonic {

/// ln(Σ exp(β vᵢ)) / β, which is at least the largest of the values, and its derivatives by them, which sum up to 1.
struct SmoothMaximum {
  double value = 0;
  Eigen::ArrayXXd weights;  ///< like the values
};

inline SmoothMaximum smoothMaximum(const Eigen::ArrayXXd& values, double sharpness) {
  const double largest = values.maxCoeff();
  SmoothMaximum result;
  result.weights = (sharpness * (values - largest)).exp();
  const double sum = result.weights.sum();
  result.value = largest + std::log(sum) / sharpness;
  result.weights /= sum;
  return result;
}

}  // namespace pliant::harmonic
