#include "ui/plots/polar_plot.hpp"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ui/plots/plot_export.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::plots {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double reach = 14;  ///< how far from a curve it is still read out [pixels]

}  // namespace

PolarPlot::PolarPlot(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setAccessibleName(tr("Polar plot"));
}

void PolarPlot::setCurves(scene::PolarCurves curves) {
  if (curves.curves.size() != curves_.curves.size()) hidden_.assign(curves.curves.size(), false);
  curves_ = std::move(curves);
  readout_.reset();
  layOut();
}

void PolarPlot::setCurveVisible(int curve, bool visible) {
  hidden_.at(static_cast<std::size_t>(curve)) = !visible;
  readout_.reset();
  layOut();
}

bool PolarPlot::isCurveVisible(int curve) const { return !hidden_.at(static_cast<std::size_t>(curve)); }

QColor PolarPlot::curveColor(int curve) const {
  const bool dark = isDark(palette());
  const PlotStyle style = plotStyle(palette());
  const std::array<QColor, 4> colors{style.curve, dark ? QColor(226, 150, 192) : QColor(160, 80, 125), style.shown,
                                     dark ? QColor(205, 180, 90) : QColor(120, 95, 0)};
  return stale_ ? style.stale : colors[static_cast<std::size_t>(curve) % colors.size()];
}

void PolarPlot::addMeasured(MeasuredTable measured) {
  std::erase_if(measured_, [&](const MeasuredTable& other) { return other.quantity == measured.quantity; });
  measured_.push_back(std::move(measured));
  layOut();
}

void PolarPlot::clearMeasured() {
  measured_.clear();
  layOut();
}

void PolarPlot::setEmptyText(const QString& text) {
  emptyText_ = text;
  update();
}

void PolarPlot::setStale(bool stale) {
  stale_ = stale;
  update();
}

void PolarPlot::layOut() {
  double low = 0, high = 0;
  const auto add = [&](double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (std::size_t i = 0; i < curves_.curves.size(); ++i) {
    if (hidden_[i]) continue;
    for (const double value : curves_.curves[i].values) add(value);
    for (const MeasuredTable& table : measured_)
      if (table.quantity.toStdString() == curves_.curves[i].name)
        for (const MeasuredValue& value : table.values) add(value.lower), add(value.upper);
  }
  // Rings at round values of the unit.
  scale_.fit(low * curves_.factor, high * curves_.factor);
  const QFontMetricsF metrics(font());
  const double line = metrics.height() + 3, side = metrics.horizontalAdvance(QStringLiteral("180°")) + 14;
  // The legend stands beside the plot where there is room.
  const bool beside = width() > 1.5 * height();
  const double foot = beside ? 0 : line * static_cast<double>(legend().size()) + 14;
  const QRectF room = QRectF(rect()).adjusted(side, metrics.height() + 12, -side, -metrics.height() - 10 - foot);
  scale_.setCircle(room.center(), std::max(20.0, std::min(room.width(), room.height()) / 2));
  update();
}

std::optional<PolarPlot::Readout> PolarPlot::readoutAt(const QPointF& place) const {
  const double pointer = scale_.angleAt(place);
  std::optional<Readout> nearest;
  double least = reach;
  for (std::size_t i = 0; i < curves_.curves.size(); ++i) {
    const scene::PolarCurve& curve = curves_.curves[i];
    if (hidden_[i] || curve.values.empty()) continue;
    // The nearest computed direction, of all around.
    std::size_t best = 0;
    double bestTurn = 0, bestAway = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < curve.angles.size(); ++k)
      for (const double turn : {0.0, pi}) {
        if (turn > 0 && !curve.halfTurn) continue;
        const double away = std::abs(std::remainder(curve.angles[k] + turn - pointer, 2 * pi));
        if (away < bestAway) best = k, bestTurn = turn, bestAway = away;
      }
    if (!std::isfinite(curve.values[best])) continue;
    const QPointF at = scale_.point(curve.angles[best] + bestTurn, curves_.factor * curve.values[best]);
    const double radial = std::abs(std::hypot(place.x() - scale_.centre().x(), place.y() - scale_.centre().y()) -
                                   scale_.radiusOf(curves_.factor * curve.values[best]));
    const double distance = std::min(radial, std::hypot(at.x() - place.x(), at.y() - place.y()));
    if (distance >= least) continue;
    least = distance;
    const auto number = [&](double value) {
      const QString digits = QString::number(std::abs(curves_.factor * value), 'f', curves_.decimals);
      const QString unit =
          curves_.unit.empty() ? QString() : QStringLiteral(" ") + QString::fromStdString(curves_.unit);
      return (value < 0 ? QStringLiteral("−") : QString()) + digits + unit;
    };
    QString text = QStringLiteral("%1°:  %2 %3")
                       .arg(std::fmod((curve.angles[best] + bestTurn) * 180 / pi, 360.0), 0, 'g', 4)
                       .arg(QString::fromStdString(curve.name), number(curve.values[best]));
    if (best < curve.uncertain.size() && std::isfinite(curve.uncertain[best]))
      text += QStringLiteral(" (± %1)").arg(curves_.factor * curve.uncertain[best], 0, 'g', 2);
    nearest = Readout{static_cast<int>(i), curve.angles[best] + bestTurn, curve.values[best], text};
  }
  return nearest;
}

QString PolarPlot::toCsv() const {
  QString csv = QStringLiteral("angle [deg]");
  const QString unit = QString::fromStdString(curves_.unit);
  for (const scene::PolarCurve& curve : curves_.curves)
    csv += QStringLiteral(",%1%2").arg(
        QString::fromStdString(curve.name), unit.isEmpty() ? QString() : QStringLiteral(" [%1]").arg(unit));
  csv += '\n';
  std::vector<double> angles;
  for (const scene::PolarCurve& curve : curves_.curves)
    angles.insert(angles.end(), curve.angles.begin(), curve.angles.end());
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  for (const double angle : angles) {
    csv += QString::number(angle * 180 / pi, 'g', 15);
    for (const scene::PolarCurve& curve : curves_.curves) {
      const auto found = std::find(curve.angles.begin(), curve.angles.end(), angle);
      csv += ',';
      if (found == curve.angles.end()) continue;
      const double value = curve.values[static_cast<std::size_t>(found - curve.angles.begin())];
      if (std::isfinite(value)) csv += QString::number(curves_.factor * value, 'g', 15);
    }
    csv += '\n';
  }
  return csv;
}

void PolarPlot::exportTo(const QString& file) {
  exportPainting(
      size(), file, [this](QPainter& painter) { paint(painter, false); }, [this] { return toCsv(); });
}

void PolarPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  paint(painter, true);
}

void PolarPlot::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layOut();
}

void PolarPlot::mouseMoveEvent(QMouseEvent* event) {
  readout_ = readoutAt(event->position());
  update();
}

void PolarPlot::leaveEvent(QEvent* event) {
  QWidget::leaveEvent(event);
  readout_.reset();
  update();
}

}  // namespace pliant::plots
