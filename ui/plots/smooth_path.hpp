#pragma once

#include <QPointF>
#include <QVector>

namespace pliant::plots {

/// The points with `between` more in each gap, on a centripetal Catmull-Rom curve (Barry and Goldman 1988), which
/// passes through all given points and makes no loops between them. Lengths are measured in units of each axis's
/// extent, so the curve does not depend on units. A point more at the end changes nothing but the last gap.
QVector<QPointF> smoothPath(const QVector<QPointF>& points, int between);

}  // namespace pliant::plots
