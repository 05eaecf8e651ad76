#include "core/harmonic/closed_spline.hpp"

#include <Eigen/LU>

namespace pliant::harmonic {

Eigen::MatrixXd closedSpline(const Eigen::MatrixXd& points, int perPiece) {
  const Eigen::Index count = points.cols();
  const auto at = [&](Eigen::Index i) { return points.col((i + count) % count); };
  // Slopes by time in pieces: s_(i-1) + 4 s_i + s_(i+1) = 3 (p_(i+1) - p_(i-1)).
  Eigen::MatrixXd system = 4 * Eigen::MatrixXd::Identity(count, count), right(count, points.rows());
  for (Eigen::Index i = 0; i < count; ++i) {
    system(i, (i + 1) % count) += 1;
    system(i, (i + count - 1) % count) += 1;
    right.row(i) = 3 * (at(i + 1) - at(i - 1)).transpose();
  }
  const Eigen::MatrixXd slopes = system.partialPivLu().solve(right).transpose();
  Eigen::MatrixXd curve(points.rows(), count * perPiece);
  for (Eigen::Index i = 0; i < count; ++i)
    for (int k = 0; k < perPiece; ++k) {
      const double t = static_cast<double>(k) / perPiece, u = 1 - t;
      curve.col(i * perPiece + k) = u * u * (1 + 2 * t) * at(i) + t * t * (3 - 2 * t) * at(i + 1) +
                                    u * u * t * slopes.col(i) - t * t * u * slopes.col((i + 1) % count);
    }
  return curve;
}

}  // namespace pliant::harmonic
