#include "core/math/phase_shift.hpp"

#include <cmath>

namespace pliant::math {

Eigen::MatrixXd shiftedInPhase(const Eigen::MatrixXd& coefficients, double phase) {
  Eigen::MatrixXd result = coefficients;
  for (Eigen::Index k = 1; 2 * k < coefficients.rows(); ++k) {
    const double c = std::cos(static_cast<double>(k) * phase), s = std::sin(static_cast<double>(k) * phase);
    result.row(2 * k - 1) = c * coefficients.row(2 * k - 1) - s * coefficients.row(2 * k);
    result.row(2 * k) = s * coefficients.row(2 * k - 1) + c * coefficients.row(2 * k);
  }
  return result;
}

}  // namespace pliant::math
