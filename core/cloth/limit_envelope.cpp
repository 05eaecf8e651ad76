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

double largestStretch(const StretchLimit& limit) {
  if (const auto* isotropic = std::get_if<IsotropicLimit>(&limit)) return isotropic->stretch;
  if (const auto* orthotropic = std::get_if<OrthotropicLimit>(&limit))
    return std::max(orthotropic->first, orthotropic->second);
  double largest = 0;  // the cubics have no extrema between the points
  for (const DirectionLimit& point : std::get<LimitCurve>(limit).points()) largest = std::max(largest, point.stretch);
  return largest;
}

}  // namespace pliant::cloth
