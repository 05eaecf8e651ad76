#include "ui/plots/shape_image.hpp"

#include <Eigen/Geometry>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "ui/plots/plot_style.hpp"
#include "ui/render/figure_layout.hpp"

namespace pliant::plots {

namespace {

constexpr double finestEdges = 8;  // [pixels²]: mean area of triangles with edges

QColor mixed(const QColor& from, const QColor& to, double share) {
  const auto between = [share](int a, int b) { return static_cast<int>(std::lround(a + share * (b - a))); };
  return {between(from.red(), to.red()), between(from.green(), to.green()), between(from.blue(), to.blue())};
}

/// Points seen isometrically: x and y on the picture (y down), z towards the eye.
Eigen::Matrix3Xd projected(Eigen::Matrix3Xd points, int dimension) {
  if (dimension < 3) {
    points.row(1) *= -1;
    return points;
  }
  const Eigen::Vector3d towards = Eigen::Vector3d(1, -1.4, 1.2).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(towards).normalized();
  Eigen::Matrix3d view;
  view << right.transpose(), -towards.cross(right).transpose(), towards.transpose();
  return view * points;
}

}  // namespace

QImage shapeImage(const mechanics::Model& model, const Eigen::VectorXd& positions, const QSize& size, double pixelRatio,
                  const QPalette& palette) {
  QImage image(size * pixelRatio, QImage::Format_ARGB32_Premultiplied);
  image.setDevicePixelRatio(pixelRatio);
  image.fill(Qt::transparent);
  const render::FigureLayout layout(model);
  const Eigen::Matrix3Xd points = projected(layout.pose(positions), model.dimension);
  const Eigen::Vector3d low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  // Everything shrinks with the picture, so that a small one is no blot.
  const double scale = std::min(1.0, std::min(size.width(), size.height()) / 150.0);
  const double margin = 16 * scale;
  const double extent = std::max(
      {(high.x() - low.x()) / (size.width() - 2 * margin), (high.y() - low.y()) / (size.height() - 2 * margin), 1e-12});
  const Eigen::Vector3d middle = (low + high) / 2;
  const auto at = [&](int node) {
    return QPointF(size.width() / 2.0 + (points(0, node) - middle.x()) / extent,
                   size.height() / 2.0 + (points(1, node) - middle.y()) / extent);
  };
  const PlotStyle style = plotStyle(palette);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  std::vector<std::array<int, 3>> triangles = layout.triangles;
  const auto depth = [&](const std::array<int, 3>& t) { return points(2, t[0]) + points(2, t[1]) + points(2, t[2]); };
  std::stable_sort(
      triangles.begin(), triangles.end(), [&](const auto& a, const auto& b) { return depth(a) < depth(b); });
  // Where triangles are as small as pixels their edges would be all there is to see.
  double area = 0;
  for (const auto& [a, b, c] : triangles)
    area += 0.5 * (points.col(b) - points.col(a)).cross(points.col(c) - points.col(a)).norm();
  const bool fine =
      !triangles.empty() && area / (extent * extent) < finestEdges * static_cast<double>(triangles.size());
  QColor fill = style.curve;
  painter.setPen(QPen(style.background, 0.7 * scale * scale));
  for (const auto& triangle : triangles) {
    const Eigen::Vector3d normal = (points.col(triangle[1]) - points.col(triangle[0]))
                                       .cross(points.col(triangle[2]) - points.col(triangle[0]))
                                       .normalized();
    const double shade = 0.45 + 0.5 * std::abs(normal.z());
    if (fine) {
      fill = mixed(style.background, style.curve, shade);
      painter.setPen(QPen(fill, 0.7));
    } else {
      fill.setAlphaF(static_cast<float>(shade));
    }
    painter.setBrush(fill);
    const QPointF corners[3] = {at(triangle[0]), at(triangle[1]), at(triangle[2])};
    painter.drawConvexPolygon(corners, 3);
  }
  const auto drawLines = [&](const std::vector<std::array<int, 2>>& lines, double width) {
    painter.setPen(QPen(style.mutedText, width));
    for (const auto& [from, to] : lines) painter.drawLine(at(from), at(to));
  };
  drawLines(layout.links, 2.5 * scale);
  drawLines(layout.coils, scale);
  painter.setPen(Qt::NoPen);
  painter.setBrush(style.text);
  for (const auto& mass : model.pointMasses)
    for (const int node : mass.nodes) painter.drawEllipse(at(node), 4 * scale, 4 * scale);
  painter.setBrush(style.shown);
  for (const auto& probe : model.probes) painter.drawEllipse(at(probe.node), 2.5 * scale, 2.5 * scale);
  return image;
}

}  // namespace pliant::plots
