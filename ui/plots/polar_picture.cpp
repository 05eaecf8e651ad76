#include "ui/plots/polar_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cloth/limit_envelope.hpp"

namespace pliant::plots {

namespace {

constexpr double beyondRings = 9;  ///< pixels to the rotation handle

}  // namespace

QPointF handlePoint(const PolarAxis& axis, const LimitShape& shape, const HandlePlace& place) {
  if (place.handle == LimitShape::rotationHandle)
    return axis.centre() + (axis.radius() + beyondRings) * QPointF(std::cos(place.angle), -std::sin(place.angle));
  return axis.point(place.angle, shape.handles().at(static_cast<std::size_t>(place.handle)).stretch);
}

void placeRingLabels(PolarAxis& axis, const PolarPicture& picture) {
  if (!picture.shape) return;
  constexpr double halfWidth = 24, halfHeight = 9;  // of a number with what it keeps clear
  constexpr double degree = std::numbers::pi / 180;
  std::vector<QPointF> taken;
  const cloth::StretchLimit limit = picture.shape->limit();
  const Eigen::Index count = picture.reached.size();
  for (int i = 0; i < 180; ++i) taken.push_back(axis.point(2 * i * degree, cloth::stretchAt(limit, 2 * i * degree)));
  for (Eigen::Index i = 0; i < 2 * count; ++i)
    taken.push_back(
        axis.point(std::numbers::pi * static_cast<double>(i) / static_cast<double>(count), picture.reached[i % count]));
  for (const HandlePlace& place : picture.shape->places()) taken.push_back(handlePoint(axis, *picture.shape, place));
  for (const MeasuredLimit& row : picture.measured)
    for (const double turn : {0.0, std::numbers::pi})
      for (const double stretch : {row.lower, row.stretch, row.upper})
        taken.push_back(axis.point(row.angle + turn, stretch));
  std::vector<double> rings{1}, angles;
  for (const double ring : axis.rings()) rings.push_back(ring);
  for (const double ring : rings) {
    double best = -1, chosen = 0;
    for (const double degrees : {-67.5, -112.5, -22.5, -157.5, 67.5, 112.5, 22.5, 157.5, -90.0, 90.0}) {
      const QPointF label = axis.point(degrees * degree, ring);
      double room = 1;
      for (const QPointF& place : taken)
        room = std::min(
            room, std::max(std::abs(place.x() - label.x()) / halfWidth, std::abs(place.y() - label.y()) / halfHeight));
      if (room <= best) continue;  // of equal ones the first
      best = room;
      chosen = degrees * degree;
    }
    angles.push_back(chosen);
    taken.push_back(axis.point(chosen, ring));
  }
  axis.setLabelAngles(std::move(angles));
}

double largestStretch(const PolarPicture& picture) {
  double largest = 1;
  if (picture.shape)
    for (const auto& handle : picture.shape->handles()) largest = std::max(largest, handle.stretch);
  for (const MeasuredLimit& row : picture.measured) largest = std::max(largest, row.upper);
  if (picture.reached.size() > 0) largest = std::max(largest, picture.reached.maxCoeff());
  return largest;
}

QString placeText(double angle, double stretch, bool percent) {
  return QStringLiteral("%1°  %2").arg(
      QString::number(angle * 180 / std::numbers::pi, 'g', 4), stretchText(stretch, percent, 3));
}

QString polarCsv(const PolarPicture& picture) {
  if (!picture.shape) return {};
  const Eigen::Index count = picture.reached.size() > 0 ? picture.reached.size() : 180;
  const bool envelope = picture.constraints && !picture.constraints->ellipses.empty();
  const cloth::StretchLimit limit = picture.shape->limit();
  QString text = QStringLiteral("angle [deg],limit");
  if (envelope) text += QStringLiteral(",enforced");
  if (picture.reached.size() > 0) text += QStringLiteral(",reached");
  text += '\n';
  const auto number = [](double value) { return QString::number(value, 'g', 17); };
  for (Eigen::Index i = 0; i < count; ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    text += number(180.0 * static_cast<double>(i) / static_cast<double>(count)) + ',' +
            number(cloth::stretchAt(limit, angle));
    if (envelope) text += ',' + number(cloth::envelopeStretch(*picture.constraints, angle));
    if (picture.reached.size() > 0) text += ',' + number(picture.reached[i]);
    text += '\n';
  }
  return text;
}

}  // namespace pliant::plots
