#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/plots/plot_style.hpp"
#include "ui/plots/polar_plot.hpp"

namespace pliant::plots {

namespace {

constexpr double pi = std::numbers::pi;

QFont smaller(QFont font) {
  font.setPointSizeF(font.pointSizeF() * 0.9);
  return font;
}

/// Text on a patch of the background, so that lines do not cross it.
void drawOnPatch(QPainter& painter, QRectF box, const QString& text, const QColor& color, QColor patch) {
  patch.setAlpha(215);
  painter.fillRect(box.adjusted(-2, 1, 2, -1), patch);
  painter.setPen(color);
  painter.drawText(box, Qt::AlignCenter, text);
}

QString ringText(double value, const render::PolarScale& scale) {
  const QString digits = QString::number(std::abs(value), 'f', scale.decimals());
  return (value < 0 && !scale.isZero(value) ? QStringLiteral("−") : QString()) + digits;
}

QColor measuredColor(const QPalette& palette) { return isDark(palette) ? QColor(240, 140, 70) : QColor(213, 94, 0); }

}  // namespace

void PolarPlot::paint(QPainter& painter, bool withReadout) const {
  const PlotStyle style = plotStyle(palette());
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), style.background);
  if (curves_.curves.empty()) {
    painter.setFont(font());
    painter.setPen(style.mutedText);
    painter.drawText(QRectF(rect()).adjusted(24, 16, -24, -16), Qt::AlignCenter | Qt::TextWordWrap, emptyText_);
    return;
  }
  painter.setFont(smaller(font()));
  paintGrid(painter);
  paintCurves(painter);
  paintMeasured(painter);
  paintGridLabels(painter);
  paintLegend(painter);
  if (withReadout) paintReadout(painter);
}

void PolarPlot::paintGrid(QPainter& painter) const {
  const PlotStyle style = plotStyle(palette());
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(style.grid, 1));
  for (int i = 0; i < 12; ++i) painter.drawLine(scale_.centre(), scale_.point(pi * i / 6, scale_.outer()));
  for (const double ring : scale_.rings()) {
    painter.setPen(scale_.isZero(ring) ? QPen(style.mutedText, 1.4) : QPen(style.grid, 1));
    painter.drawEllipse(scale_.centre(), scale_.radiusOf(ring), scale_.radiusOf(ring));
  }
}

/// Numbers of the rings on the spoke where curves leave them most room, and those of the directions around.
void PolarPlot::paintGridLabels(QPainter& painter) const {
  const PlotStyle style = plotStyle(palette());
  const QFontMetricsF metrics(painter.font());
  double chosen = 5 * pi / 12, most = -1;
  for (const double twelfths : {5, 7}) {  // steep, so that numbers do not run into each other
    const double angle = pi / 12 * twelfths;
    double least = scale_.radius();
    for (std::size_t i = 0; i < curves_.curves.size(); ++i) {
      const scene::PolarCurve& curve = curves_.curves[i];
      for (std::size_t k = 0; !hidden_[i] && k < curve.angles.size(); ++k)
        if (std::isfinite(curve.values[k]) && std::abs(std::remainder(curve.angles[k] - angle, pi)) < 0.12)
          for (const double ring : scale_.rings())
            least =
                std::min(least, std::abs(scale_.radiusOf(curves_.factor * curve.values[k]) - scale_.radiusOf(ring)));
    }
    if (least > most + 1) most = least, chosen = angle;
  }
  double last = -1e9;
  for (const double ring : scale_.rings()) {
    const double radius = scale_.radiusOf(ring);
    if (radius - last < 0.9 * metrics.height()) continue;
    last = radius;
    QString text = ringText(ring, scale_);
    if (ring == scale_.rings().back() && !curves_.unit.empty()) text += ' ' + QString::fromStdString(curves_.unit);
    QRectF box(QPointF(), metrics.size(0, text));
    box.moveCenter(scale_.point(chosen, ring));
    drawOnPatch(painter, box, text, style.mutedText, style.background);
  }
  for (int i = 0; i < 12; ++i) {
    const double angle = pi * i / 6;
    const QString text = QStringLiteral("%1°").arg(30 * i);
    QRectF box(QPointF(), metrics.size(0, text));
    const double away = scale_.radius() + 6;
    box.moveCenter(scale_.centre() +
                   QPointF((away + box.width() / 2) * std::cos(angle), -(away + box.height() / 2) * std::sin(angle)));
    painter.setPen(i % 3 == 0 ? style.text : style.mutedText);
    painter.drawText(box, Qt::AlignCenter, text);
  }
}

void PolarPlot::paintCurves(QPainter& painter) const {
  for (std::size_t i = 0; i < curves_.curves.size(); ++i) {
    const scene::PolarCurve& curve = curves_.curves[i];
    if (hidden_[i] || curve.angles.empty()) continue;
    QPainterPath path;
    std::vector<QPointF> run, dots;  // a value without neighbours is a dot
    const auto end = [&] {
      if (run.size() == 1) dots.push_back(run[0]);
      for (std::size_t k = 0; k < run.size(); ++k) k == 0 ? path.moveTo(run[k]) : path.lineTo(run[k]);
      run.clear();
    };
    const auto add = [&](double angle, double value) {
      if (std::isfinite(value))
        run.push_back(scale_.point(angle, curves_.factor * value));
      else
        end();
    };
    for (const double turn : {0.0, pi})
      for (std::size_t k = 0; k < curve.angles.size() && (turn == 0 || curve.halfTurn); ++k)
        add(curve.angles[k] + turn, curve.values[k]);
    add(curve.angles.front(), curve.values.front());
    end();
    const QColor color = curveColor(static_cast<int>(i));
    painter.setPen(
        QPen(color, 2.2 * curve.width, curve.dashed ? Qt::DashLine : Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(path);
    painter.setPen(Qt::NoPen);
    painter.setBrush(color);
    for (const QPointF& dot : dots) painter.drawEllipse(dot, 3, 3);
  }
}

void PolarPlot::paintMeasured(QPainter& painter) const {
  const QColor color = measuredColor(palette());
  for (const MeasuredTable& table : measured_)
    for (std::size_t i = 0; i < curves_.curves.size(); ++i) {
      if (hidden_[i] || curves_.curves[i].name != table.quantity.toStdString()) continue;
      for (const MeasuredValue& value : table.values) {
        const QPointF across = 3.5 * QPointF(std::sin(value.angle), std::cos(value.angle));
        const auto at = [&](double number) { return scale_.point(value.angle, curves_.factor * number); };
        painter.setPen(QPen(color, 1.6));
        painter.drawLine(at(value.lower), at(value.upper));
        if (value.upper > value.lower)
          for (const double end : {value.lower, value.upper}) painter.drawLine(at(end) - across, at(end) + across);
        painter.setBrush(color);
        painter.drawEllipse(at(value.value), 2.6, 2.6);
      }
    }
}

std::vector<PolarPlot::LegendLine> PolarPlot::legend() const {
  std::vector<LegendLine> lines;
  bool anyMeasured = false;
  for (std::size_t i = 0; i < curves_.curves.size(); ++i) {
    if (hidden_[i]) continue;
    const QString name = QString::fromStdString(curves_.curves[i].name);
    const scene::PolarCurve& curve = curves_.curves[i];
    lines.push_back(
        {name, QPen(curveColor(static_cast<int>(i)), 2.2 * curve.width, curve.dashed ? Qt::DashLine : Qt::SolidLine)});
    anyMeasured = anyMeasured || std::any_of(measured_.begin(), measured_.end(),
                                             [&](const MeasuredTable& table) { return table.quantity == name; });
  }
  if (anyMeasured) lines.push_back({tr("measured"), QPen(measuredColor(palette()), 2.2)});
  if (!curves_.note.empty()) lines.push_back({QString::fromStdString(curves_.note), QPen(Qt::NoPen)});
  return lines;
}

void PolarPlot::paintLegend(QPainter& painter) const {
  const QFontMetricsF metrics(painter.font());
  const double line = metrics.height() + 3;
  const auto lines = legend();
  double y = height() - 6 - line * (static_cast<double>(lines.size()) - 0.5);
  for (const auto& [text, pen] : lines) {
    painter.setPen(pen);
    painter.drawLine(QPointF(12, y), QPointF(30, y));
    painter.setPen(plotStyle(palette()).text);
    painter.drawText(QRectF(38, y - line / 2, width() - 46, line), Qt::AlignLeft | Qt::AlignVCenter, text);
    y += line;
  }
}

void PolarPlot::paintReadout(QPainter& painter) const {
  if (!readout_) return;
  const PlotStyle style = plotStyle(palette());
  const QPointF at = scale_.point(readout_->angle, curves_.factor * readout_->value);
  painter.setPen(QPen(style.background, 1.5));
  painter.setBrush(curveColor(readout_->curve));
  painter.drawEllipse(at, 5, 5);
  QRectF box(QPointF(), QFontMetricsF(painter.font()).size(0, readout_->text) + QSizeF(12, 6));
  box.moveBottomLeft(at + QPointF(10, -8));
  if (box.right() > width() - 2) box.moveRight(std::min(at.x() - 10, width() - 2.0));
  if (box.left() < 2) box.moveLeft(2);
  if (box.top() < 2) box.moveTop(at.y() + 10);
  painter.setPen(QPen(style.mutedText, 1));
  painter.setBrush(style.background);
  painter.drawRoundedRect(box, 3, 3);
  painter.setPen(style.text);
  painter.drawText(box, Qt::AlignCenter, readout_->text);
}

}  // namespace pliant::plots
