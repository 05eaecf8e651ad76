#include "core/cloth/limit_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pliant::cloth {

double envelopeStretch(const LimitConstraints& constraints, double angle) {
  const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
  double smallest = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix2d& ellipse : constraints.ellipses)
    smallest = std::min(smallest, direction.dot(ellipse * direction));
  return std::sqrt(smallest);
}

}  // namespace pliant::cloth
