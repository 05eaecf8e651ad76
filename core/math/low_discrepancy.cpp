#include "core/math/low_discrepancy.hpp"

#include <cmath>
#include <random>

namespace pliant::math {

EvenPoints::EvenPoints(int dimension, unsigned seed) : start_(dimension), step_(dimension) {
  double root = 2;
  for (int i = 0; i < 100; ++i) root = std::pow(1 + root, 1.0 / (dimension + 1));
  std::mt19937 random(seed);
  for (int i = 0; i < dimension; ++i) {
    step_[i] = std::pow(root, -(i + 1));
    start_[i] = static_cast<double>(random()) / 4294967296.0;  // the same with every library
  }
}

Eigen::VectorXd EvenPoints::operator[](int i) const {
  return (start_ + static_cast<double>(i) * step_).unaryExpr([](double x) { return x - std::floor(x); });
}

}  // namespace pliant::math
