#include "ui/plots/smooth_path.hpp"

#include <algorithm>
#include <cmath>

namespace pliant::plots {
namespace {

/// Where the line through (ta, a) and (tb, b) is at t; a where they coincide.
QPointF between(const QPointF& a, double ta, const QPointF& b, double tb, double t) {
  return tb > ta ? a + (b - a) * ((t - ta) / (tb - ta)) : a;
}

double extent(const QVector<QPointF>& points, double (*coordinate)(const QPointF&)) {
  double least = coordinate(points.front()), most = least;
  for (const QPointF& point : points) {
    least = std::min(least, coordinate(point));
    most = std::max(most, coordinate(point));
  }
  return most > least ? most - least : 1.0;
}

}  // namespace

QVector<QPointF> smoothPath(const QVector<QPointF>& points, int betweenTwo) {
  if (points.size() < 3) return points;
  const double width = extent(points, [](const QPointF& p) { return p.x(); });
  const double height = extent(points, [](const QPointF& p) { return p.y(); });
  const auto knotStep = [&](const QPointF& a, const QPointF& b) {
    return std::sqrt(std::hypot((b.x() - a.x()) / width, (b.y() - a.y()) / height));
  };
  QVector<QPointF> path;
  path.reserve((points.size() - 1) * (betweenTwo + 1) + 1);
  for (qsizetype i = 0; i + 1 < points.size(); ++i) {
    const QPointF& p1 = points[i];
    const QPointF& p2 = points[i + 1];
    // Beyond the ends the curve goes on straight.
    const QPointF p0 = i > 0 ? points[i - 1] : 2 * p1 - p2;
    const QPointF p3 = i + 2 < points.size() ? points[i + 2] : 2 * p2 - p1;
    const double t0 = 0, t1 = t0 + knotStep(p0, p1), t2 = t1 + knotStep(p1, p2), t3 = t2 + knotStep(p2, p3);
    path.push_back(p1);
    if (t2 <= t1) continue;
    for (int k = 1; k <= betweenTwo; ++k) {
      const double t = t1 + (t2 - t1) * k / (betweenTwo + 1);
      const QPointF a1 = t1 > t0 ? between(p0, t0, p1, t1, t) : p1;
      const QPointF a2 = between(p1, t1, p2, t2, t);
      const QPointF a3 = t3 > t2 ? between(p2, t2, p3, t3, t) : p2;
      const QPointF b1 = between(a1, t0, a2, t2, t);
      const QPointF b2 = between(a2, t1, a3, t3, t);
      path.push_back(between(b1, t1, b2, t2, t));
    }
  }
  path.push_back(points.back());
  return path;
}

}  // namespace pliant::plots
