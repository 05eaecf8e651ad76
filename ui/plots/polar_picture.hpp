#pragma once

#include <Eigen/Core>
#include <QPointF>
#include <QString>
#include <optional>

#include "ui/plots/limit_shape.hpp"
#include "ui/plots/measured_limit.hpp"
#include "ui/plots/polar_axis.hpp"

namespace pliant::plots {

/// What a polar plot of a stretch limit shows.
struct PolarPicture {
  std::optional<LimitShape> shape;                     ///< none: `emptyText` stands in its place
  std::optional<cloth::LimitConstraints> constraints;  ///< with which it is enforced
  std::vector<MeasuredLimit> measured;
  Eigen::VectorXd reached;  ///< largest stretch in the directions π i / size
  QString reachedName;      ///< whose that is
  QString emptyText;
  bool handles = true;   ///< what can be dragged
  bool captions = true;  ///< legend and numbers
  bool percent = false;  ///< strains in % instead of stretches
  int selected = -1;     ///< a handle
  int numbered = -1;     ///< a place of `LimitShape::places` whose number stands beside it
};

/// Where a handle is seen, in pixels; the rotation handle lies beyond the outermost ring.
QPointF handlePoint(const PolarAxis& axis, const LimitShape& shape, const HandlePlace& place);

/// Puts the numbers of the rings where curves and handles leave them room.
void placeRingLabels(PolarAxis& axis, const PolarPicture& picture);

/// The largest stretch that the picture shows.
double largestStretch(const PolarPicture& picture);

/// "45°  1.120" or "45°  +12.0 %".
QString placeText(double angle, double stretch, bool percent);

/// All numbers that are drawn: a row a direction of half a turn, columns for what there is.
QString polarCsv(const PolarPicture& picture);

}  // namespace pliant::plots
