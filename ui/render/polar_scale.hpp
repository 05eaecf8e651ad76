#pragma once

#include <vector>

namespace pliant::render {

/// How values of either sign lie on the radius of a polar plot: linearly from `inner` in the middle to `outer` at the
/// rim. Zero is the middle itself if no value is negative, else a ring.
class PolarScale {
 public:
  /// Shows all between the two.
  void fit(double smallest, double largest);
  double inner() const { return inner_; }
  double outer() const { return outer_; }
  /// Round values, 0 among them where it is a ring, from the smallest.
  const std::vector<double>& rings() const { return rings_; }
  double step() const { return step_; }
  bool isZero(double ring) const { return ring < 1e-9 * step_ && ring > -1e-9 * step_; }
  /// Digits after the point that tell neighbouring rings apart.
  int decimals() const;
  /// Of the radius; 0 for what is below `inner`.
  double fraction(double value) const;

 private:
  double inner_ = 0, outer_ = 1, step_ = 0.5;
  std::vector<double> rings_{0.5, 1};
};

}  // namespace pliant::render
