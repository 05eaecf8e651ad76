#pragma once

#include <Eigen/Core>

namespace pliant::math {

/// Points that fill the unit cube evenly, whatever their number: the additive recurrence x_i = {x_0 + i (φ⁻¹, ...,
/// φ⁻ᵈ)} of Roberts (2018), where φ is the positive root of φ^(d+1) = φ + 1, the golden ratio if d = 1. x_0 is random,
/// of a seed.
class EvenPoints {
 public:
  EvenPoints(int dimension, unsigned seed);
  /// The i-th point, i >= 0; coordinates in [0, 1).
  Eigen::VectorXd operator[](int i) const;

 private:
  Eigen::VectorXd start_, step_;
};

}  // namespace pliant::math
