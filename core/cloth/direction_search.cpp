#include "core/cloth/direction_search.hpp"

namespace pliant::cloth {

std::vector<double> samplingAngles(const StretchLimit& limit, int count) {
  constexpr double pi = std::numbers::pi;
  constexpr int leastInPiece = 16;
  std::vector<double> angles;
  const auto fill = [&](double begin, double end) {
    const int steps = std::max(leastInPiece, static_cast<int>(std::ceil((end - begin) * count / pi)));
    for (int i = 0; i < steps; ++i) {
      const double angle = begin + (end - begin) * i / steps;
      angles.push_back(angle < pi ? angle : angle - pi);
    }
  };
  if (const auto* curve = std::get_if<LimitCurve>(&limit)) {
    const std::vector<DirectionLimit>& points = curve->points();
    for (std::size_t i = 0; i < points.size(); ++i)
      fill(points[i].angle, i + 1 < points.size() ? points[i + 1].angle : points[0].angle + pi);
  } else {
    fill(0, pi);
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

}  // namespace pliant::cloth
