#include "core/interlock/elliptic_wire.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/error.hpp"

namespace pliant::interlock {

std::vector<SectionDisc> sectionDiscs(double a, double b, int count) {
  std::vector<SectionDisc> discs;
  for (int i = 0; i < count; ++i) {
    // Touches the ellipse at (a c, ± b s); its centre is where the normals there meet the longer axis.
    const double c = 1 - 2.0 * i / (count - 1), s = std::sqrt(std::max(0.0, 1 - c * c));
    discs.push_back({(a - b * b / a) * c, b / a * std::hypot(a * s, b * c)});
  }
  return discs;
}

double sectionError(double a, double b, int count) {
  const std::vector<SectionDisc> discs = sectionDiscs(a, b, count);
  double largest = 0;
  for (std::size_t i = 0; i + 1 < discs.size(); ++i) {
    // Two discs meet at (x, y); of the ellipse, whose distance from there is wanted, the nearest place is found by
    // Newton's method for the angle.
    const auto [x0, r0] = discs[i];
    const auto [x1, r1] = discs[i + 1];
    const double x = 0.5 * (x0 + x1) + (r0 * r0 - r1 * r1) / (2 * (x1 - x0));
    const double y = std::sqrt(std::max(0.0, r0 * r0 - (x - x0) * (x - x0)));
    double angle = std::atan2(y / b, x / a);
    for (int k = 0; k < 50; ++k) {
      const double c = std::cos(angle), s = std::sin(angle);
      const double slope = (a * a - b * b) * c * s - x * a * s + y * b * c;
      const double curvature = (a * a - b * b) * (c * c - s * s) - x * a * c - y * b * s;
      const double step = slope / curvature;
      angle -= step;
      if (std::abs(step) < 1e-14) break;
    }
    largest = std::max(largest, std::hypot(a * std::cos(angle) - x, b * std::sin(angle) - y));
  }
  return largest;
}

std::vector<DilatedPiece> ellipticRing(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double ring,
                                       double radius, double aspect) {
  if (!(aspect >= 1.0 / 3 && aspect <= 3)) {
    std::ostringstream text;
    text << "the aspect of a wire's cross-section must be between 1/3 and 3, but is " << aspect;
    throw base::InputError("", text.str());
  }
  if (aspect == 1) return {wire(ClosedCurve::circle(centre, normal, ring), radius)};
  const bool upright = aspect > 1;
  const double a = upright ? aspect * radius : radius, b = upright ? radius : aspect * radius;
  int count = 3;
  while (sectionError(a, b, count) > largestSectionError * b) count += 2;
  std::vector<DilatedPiece> bundle;
  const Eigen::Vector3d axis = normal.normalized();
  for (const auto& [offset, own] : sectionDiscs(a, b, count))
    bundle.push_back(upright ? wire(ClosedCurve::circle(centre + offset * axis, axis, ring), own)
                             : wire(ClosedCurve::circle(centre, axis, ring + offset), own));
  return bundle;
}

std::vector<Link> bundledLinks(const std::vector<Link>& links, int count) {
  std::vector<Link> result;
  for (const Link& link : links)
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) {
        Link own = link;
        own.pieceA = link.pieceA * count + i;
        own.pieceB = link.pieceB * count + j;
        result.push_back(own);
      }
  return result;
}

}  // namespace pliant::interlock
