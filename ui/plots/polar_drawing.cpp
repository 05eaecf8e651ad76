#include "ui/plots/polar_drawing.hpp"

#include <QFontMetricsF>
#include <QObject>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/cloth/limit_envelope.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::plots {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int curvePieces = 360;
constexpr double handleSize = 5;  ///< radius in pixels

/// Colours beside those of every plot: Okabe and Ito's purple and vermilion.
struct PolarColors {
  PlotStyle style;
  QColor enforced, measured;
};

PolarColors polarColors(const QPalette& palette) {
  const bool dark = isDark(palette);
  return {plotStyle(palette), dark ? QColor(226, 150, 192) : QColor(160, 80, 125),
          dark ? QColor(240, 140, 70) : QColor(213, 94, 0)};
}

QFont smallFont(QFont font) {
  font.setPointSizeF(font.pointSizeF() * 0.9);
  return font;
}

struct LegendLine {
  QString text;
  QColor color;
  enum class Mark { line, dashes, tick, dot } mark;
};

std::vector<LegendLine> legendLines(const PolarPicture& picture, const PolarColors& colors) {
  using Mark = LegendLine::Mark;
  std::vector<LegendLine> lines;
  if (!picture.shape || !picture.captions) return lines;
  lines.push_back({QObject::tr("limit"), colors.style.curve, Mark::line});
  if (picture.constraints && picture.constraints->overshoot > 0) {
    const bool ellipses = !picture.constraints->ellipses.empty();
    const auto count = ellipses ? picture.constraints->ellipses.size() : picture.constraints->directions.size();
    lines.push_back({(ellipses ? QObject::tr("enforced by %1 ellipses, at most %2 % beyond")
                               : QObject::tr("enforced in %1 directions, at most %2 % beyond"))
                         .arg(count)
                         .arg(100 * picture.constraints->overshoot, 0, 'g', 2),
                     colors.enforced, ellipses ? Mark::dashes : Mark::tick});
  }
  if (picture.reached.size() > 0)
    lines.push_back({QObject::tr("reached: %1").arg(picture.reachedName), colors.style.shown, Mark::line});
  if (!picture.measured.empty()) lines.push_back({QObject::tr("measured"), colors.measured, Mark::dot});
  return lines;
}

/// A closed curve over the full circle of a function of period π.
QPainterPath closedCurve(const PolarAxis& axis, const std::function<double(double)>& stretch) {
  QPainterPath path;
  std::vector<double> half;
  for (int i = 0; i < curvePieces / 2; ++i) half.push_back(stretch(2 * pi * i / curvePieces));
  for (int i = 0; i < curvePieces; ++i) {
    const QPointF place = axis.point(2 * pi * i / curvePieces, half[static_cast<std::size_t>(i % (curvePieces / 2))]);
    i == 0 ? path.moveTo(place) : path.lineTo(place);
  }
  path.closeSubpath();
  return path;
}

/// Text on a patch of the background, so that lines do not cross it.
void drawLabel(QPainter& painter, const QPointF& place, Qt::Alignment alignment, const QString& text,
               const QColor& color, QColor patch) {
  const QSizeF size = QFontMetricsF(painter.font()).size(0, text);
  QRectF box(place, size);
  box.moveCenter(place);
  if (alignment & Qt::AlignLeft) box.moveLeft(place.x());
  if (alignment & Qt::AlignRight) box.moveRight(place.x());
  if (alignment & Qt::AlignTop) box.moveTop(place.y());
  if (alignment & Qt::AlignBottom) box.moveBottom(place.y());
  patch.setAlpha(205);
  painter.fillRect(box.adjusted(-2, 1, 2, -1), patch);
  painter.setPen(color);
  painter.drawText(box, Qt::AlignCenter, text);
}

void drawGrid(QPainter& painter, const PolarAxis& axis, const PlotStyle& style) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(style.grid, 1));
  for (int i = 0; i < 8; ++i) {
    const double angle = pi * i / 4;
    painter.drawLine(axis.point(angle, axis.inner()), axis.point(angle, axis.outer()));
  }
  for (const double ring : axis.rings()) painter.drawEllipse(axis.centre(), axis.radiusOf(ring), axis.radiusOf(ring));
  painter.drawEllipse(axis.centre(), axis.radius(), axis.radius());
  painter.setPen(QPen(style.mutedText, 1.2));
  painter.drawEllipse(axis.centre(), axis.radiusOf(1), axis.radiusOf(1));
}

void drawGridLabels(QPainter& painter, const PolarAxis& axis, const PolarPicture& picture, const PlotStyle& style) {
  const double step = axis.rings().empty() ? 0.1 : axis.rings().front() - 1;
  const int decimals = std::max(2, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  std::size_t next = 0;
  const auto ring = [&](double stretch, const QString& text) {
    const QPointF place = axis.point(axis.labelAngle(next++), stretch);
    drawLabel(painter, place, {}, text, style.mutedText, style.background);
  };
  ring(1, QObject::tr("rest"));
  for (const double stretch : axis.rings()) ring(stretch, stretchText(stretch, picture.percent, decimals));
  const auto around = [&](double angle, Qt::Alignment alignment, const QString& text, const QColor& color) {
    const QPointF edge = axis.centre() + (axis.radius() + 6) * QPointF(std::cos(angle), -std::sin(angle));
    drawLabel(painter, edge, alignment, text, color, style.background);
  };
  around(0, Qt::AlignLeft, QObject::tr("warp\n0°"), style.text);
  around(pi / 2, Qt::AlignBottom, QObject::tr("90° weft"), style.text);
  around(pi / 4, Qt::AlignLeft | Qt::AlignBottom, QStringLiteral("45°"), style.mutedText);
  around(3 * pi / 4, Qt::AlignRight | Qt::AlignBottom, QStringLiteral("135°"), style.mutedText);
}

void drawConstraints(QPainter& painter, const PolarAxis& axis, const cloth::LimitConstraints& constraints,
                     const cloth::StretchLimit& limit, const QColor& color) {
  if (constraints.overshoot <= 0) return;  // exact: it is the limit itself
  painter.setBrush(Qt::NoBrush);
  if (!constraints.ellipses.empty()) {
    painter.setPen(QPen(color, 1.4, Qt::DashLine));
    painter.drawPath(closedCurve(axis, [&](double angle) { return cloth::envelopeStretch(constraints, angle); }));
  }
  painter.setPen(QPen(color, 2, Qt::SolidLine, Qt::RoundCap));
  for (const cloth::DirectionLimit& direction : constraints.directions)
    for (const double turn : {0.0, pi}) {
      const double angle = direction.angle + turn;
      const QPointF outward(std::cos(angle), -std::sin(angle));
      const QPointF middle = axis.point(angle, cloth::stretchAt(limit, direction.angle));
      painter.drawLine(middle - 6 * outward, middle + 6 * outward);
    }
}

void drawReached(QPainter& painter, const PolarAxis& axis, const Eigen::VectorXd& reached, const QColor& color) {
  QPainterPath path;
  const Eigen::Index count = reached.size();
  for (Eigen::Index i = 0; i < 2 * count; ++i) {
    const QPointF place = axis.point(pi * static_cast<double>(i) / static_cast<double>(count), reached[i % count]);
    i == 0 ? path.moveTo(place) : path.lineTo(place);
  }
  path.closeSubpath();
  painter.setPen(QPen(color, 1.8));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(path);
}

void drawMeasured(QPainter& painter, const PolarAxis& axis, const std::vector<MeasuredLimit>& measured,
                  const PolarColors& colors) {
  for (const MeasuredLimit& row : measured)
    for (const double turn : {0.0, pi}) {
      const double angle = row.angle + turn;
      const QPointF across(3 * std::sin(angle), 3 * std::cos(angle));
      painter.setPen(QPen(colors.measured, 1.4));
      if (row.upper > row.lower) {
        const QPointF low = axis.point(angle, row.lower), high = axis.point(angle, row.upper);
        painter.drawLine(low, high);
        for (const QPointF& end : {low, high}) painter.drawLine(end - across, end + across);
      }
      painter.setPen(QPen(colors.style.background, 1));
      painter.setBrush(colors.measured);
      painter.drawEllipse(axis.point(angle, row.stretch), 3.2, 3.2);
    }
}

void drawHandles(QPainter& painter, const PolarAxis& axis, const PolarPicture& picture, const PlotStyle& style) {
  const LimitShape& shape = *picture.shape;
  for (const HandlePlace& place : shape.places()) {
    const QPointF at = handlePoint(axis, shape, place);
    const bool selected = place.handle == picture.selected;
    painter.setPen(QPen(style.curve, selected ? 2.4 : 1.8));
    painter.setBrush(selected ? style.curve : style.background);
    if (place.handle == LimitShape::rotationHandle) {
      painter.save();
      painter.translate(at);
      painter.rotate(45);
      painter.drawRect(QRectF(-4, -4, 8, 8));
      painter.restore();
      continue;
    }
    const bool image = place.reflected || place.turn != 0;
    const double size = image ? handleSize - 1.4 : handleSize;
    painter.drawEllipse(at, size, size);
    if (!selected || image) continue;
    QColor halo = style.curve;
    halo.setAlpha(80);
    painter.setPen(QPen(halo, 3));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(at, size + 3.5, size + 3.5);
  }
}

void drawNumber(QPainter& painter, const QRectF& area, const PolarAxis& axis, const PolarPicture& picture,
                const PlotStyle& style) {
  const auto places = picture.shape->places();
  if (picture.numbered < 0 || picture.numbered >= static_cast<int>(places.size())) return;
  const HandlePlace& place = places[static_cast<std::size_t>(picture.numbered)];
  const bool rotates = place.handle == LimitShape::rotationHandle;
  const auto& handle = picture.shape->handles().at(rotates ? 0 : static_cast<std::size_t>(place.handle));
  QString text = placeText(place.angle, handle.stretch, picture.percent);
  if (rotates) text = QStringLiteral("%1°").arg(handle.angle * 180 / pi, 0, 'g', 4);
  if (picture.shape->kind() == LimitKind::isotropic) text = text.section(QStringLiteral("  "), 1);
  const QPointF at = handlePoint(axis, *picture.shape, place);
  QRectF box(QPointF(), QFontMetricsF(painter.font()).size(0, text) + QSizeF(12, 6));
  box.moveBottomLeft(at + QPointF(10, -8));
  if (box.right() > area.right() - 2) box.moveRight(std::min(at.x() - 10, area.right() - 2));
  if (box.top() < area.top() + 2) box.moveTop(at.y() + 10);
  painter.setPen(QPen(style.mutedText, 1));
  painter.setBrush(style.background);
  painter.drawRoundedRect(box, 3, 3);
  painter.setPen(style.text);
  painter.drawText(box, Qt::AlignCenter, text);
}

void drawLegend(QPainter& painter, const QRectF& area, const std::vector<LegendLine>& lines, const PlotStyle& style) {
  const double height = QFontMetricsF(painter.font()).height() + 3;
  double y = area.bottom() - 4 - height * static_cast<double>(lines.size()) + height / 2;
  const double left = area.left() + 12;
  for (const LegendLine& line : lines) {
    using Mark = LegendLine::Mark;
    painter.setPen(QPen(line.color, 2, line.mark == Mark::dashes ? Qt::DashLine : Qt::SolidLine));
    if (line.mark == Mark::line || line.mark == Mark::dashes)
      painter.drawLine(QPointF(left, y), QPointF(left + 18, y));
    else
      painter.drawLine(QPointF(left + 9, y - 5), QPointF(left + 9, y + 5));
    if (line.mark == Mark::dot) {
      painter.setBrush(line.color);
      painter.drawEllipse(QPointF(left + 9, y), 2.4, 2.4);
    }
    painter.setPen(style.text);
    painter.drawText(QRectF(left + 26, y - height / 2, area.right() - left - 30, height),
                     Qt::AlignLeft | Qt::AlignVCenter, line.text);
    y += height;
  }
}

}  // namespace

void layOutPolar(PolarAxis& axis, const QRectF& area, const PolarPicture& picture, const QFont& font) {
  const QFontMetricsF metrics(smallFont(font));
  const auto lines = static_cast<double>(legendLines(picture, polarColors({})).size());
  const double side = picture.captions ? metrics.horizontalAdvance(QObject::tr("warp")) + 12 : 14;
  const double top = picture.captions ? metrics.height() + 12 : 14;
  const double bottom = lines > 0 ? lines * (metrics.height() + 3) + 16 : 14;
  const QRectF room = area.adjusted(side, top, -side, -bottom);
  axis.setCircle(room.center(), std::max(20.0, std::min(room.width(), room.height()) / 2));
}

void paintPolar(QPainter& painter, const QRectF& area, const PolarAxis& axis, const PolarPicture& picture,
                const QPalette& palette, const QFont& font) {
  const PolarColors colors = polarColors(palette);
  const PlotStyle& style = colors.style;
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(area, style.background);
  if (!picture.shape) {
    painter.setFont(font);
    painter.setPen(style.mutedText);
    painter.drawText(area.adjusted(24, 16, -24, -16), Qt::AlignCenter | Qt::TextWordWrap, picture.emptyText);
    return;
  }
  painter.setFont(smallFont(font));
  drawGrid(painter, axis, style);
  const cloth::StretchLimit limit = picture.shape->limit();
  const QPainterPath curve = closedCurve(axis, [&](double angle) { return cloth::stretchAt(limit, angle); });
  QColor tint = style.curve;
  tint.setAlpha(26);
  painter.fillPath(curve, tint);
  if (picture.captions) drawGridLabels(painter, axis, picture, style);
  if (picture.constraints) drawConstraints(painter, axis, *picture.constraints, limit, colors.enforced);
  painter.setPen(QPen(style.curve, 2.2));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(curve);
  if (picture.reached.size() > 0) drawReached(painter, axis, picture.reached, style.shown);
  drawMeasured(painter, axis, picture.measured, colors);
  if (picture.handles) drawHandles(painter, axis, picture, style);
  drawLegend(painter, area, legendLines(picture, colors), style);
  if (picture.handles) drawNumber(painter, area, axis, picture, style);
}

}  // namespace pliant::plots
