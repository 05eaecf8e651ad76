#include "ui/panels/parameter_slider.hpp"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

namespace {
constexpr double handleRadius = 7;
constexpr double faintest = 0.4;  // of a track where nothing can be trusted
constexpr int steps = 10000;      ///< of the integer range that assistive technology sees
}  // namespace

ParameterSlider::ParameterSlider(QWidget* parent) : QAbstractSlider(parent) {
  setOrientation(Qt::Horizontal);
  setRange(0, steps);
  setSingleStep(steps / 100);
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setCursor(Qt::PointingHandCursor);
}

void ParameterSlider::setBounds(double minimum, double maximum) {
  minimum_ = minimum;
  maximum_ = maximum > minimum ? maximum : minimum + 1;
  put(value_);
}

void ParameterSlider::setRealValue(double value) {
  if (!dragging_) put(value);
}

void ParameterSlider::setReference(double reference) {
  reference_ = reference;
  update();
}

void ParameterSlider::setPlannedStep(double step) {
  if (step == planned_) return;
  planned_ = step;
  update();
}

void ParameterSlider::setTrusted(double low, double high) {
  trustedLow_ = low;
  trustedHigh_ = high;
  trustKnown_ = true;
  update();
}

void ParameterSlider::clearTrusted() {
  if (!trustKnown_) return;
  trustKnown_ = false;
  update();
}

double ParameterSlider::trustAt(double value) const {
  if (!trustKnown_ || (value >= trustedLow_ && value <= trustedHigh_)) return 1;
  const double reach = std::max(0.5 * (trustedHigh_ - trustedLow_), 1e-6 * (maximum_ - minimum_));
  const double beyond = value < trustedLow_ ? trustedLow_ - value : value - trustedHigh_;
  return std::max(0.0, 1 - beyond / reach);
}

/// A colour that fades along the track as trust does.
QBrush ParameterSlider::faded(const QColor& color) const {
  if (!trustKnown_) return color;
  constexpr int stops = 48;
  QLinearGradient gradient(handleRadius + 1, 0, width() - handleRadius - 1, 0);
  for (int i = 0; i <= stops; ++i) {
    const double fraction = static_cast<double>(i) / stops;
    QColor here = color;
    here.setAlphaF(
        static_cast<float>(faintest + (1 - faintest) * trustAt(minimum_ + fraction * (maximum_ - minimum_))));
    gradient.setColorAt(fraction, here);
  }
  return gradient;
}

void ParameterSlider::paintPlan(QPainter& painter, const QColor& color) const {
  if (planned_ == 0 || !isEnabled()) return;
  const double middle = height() / 2.0, from = positionOf(value_);
  const double to = positionOf(std::clamp(value_ + planned_ * (maximum_ - minimum_), minimum_, maximum_));
  const double sign = planned_ > 0 ? 1 : -1;
  const double begin = from + sign * (handleRadius + 1);
  if (sign * (to - begin) < 2) return;
  painter.setPen(QPen(color, 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawLine(QPointF(begin, middle), QPointF(to, middle));
  painter.drawPolyline(QPolygonF({{to - 4 * sign, middle - 4}, {to, middle}, {to - 4 * sign, middle + 4}}));
}

void ParameterSlider::put(double value) {
  value_ = value;
  const double fraction = std::clamp((value - minimum_) / (maximum_ - minimum_), 0.0, 1.0);
  setSliderPosition(static_cast<int>(std::lround(fraction * steps)));
  update();
}

double ParameterSlider::positionOf(double value) const {
  const double fraction = std::clamp((value - minimum_) / (maximum_ - minimum_), 0.0, 1.0);
  return handleRadius + 1 + fraction * (width() - 2 * handleRadius - 2);
}

double ParameterSlider::valueAt(double x) const {
  const double fraction = (x - handleRadius - 1) / std::max(1.0, width() - 2 * handleRadius - 2);
  return minimum_ + std::clamp(fraction, 0.0, 1.0) * (maximum_ - minimum_);
}

QPoint ParameterSlider::handlePosition() const {
  return {static_cast<int>(std::lround(positionOf(value_))), height() / 2};
}

void ParameterSlider::paintEvent(QPaintEvent*) {
  const plots::PlotStyle style = plots::plotStyle(palette());
  const bool moved = std::abs(value_ - reference_) > 1e-9 * (maximum_ - minimum_);
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double middle = height() / 2.0;
  const double handle = positionOf(value_);
  const double solved = positionOf(reference_);
  const auto line = [&](double from, double to, const QBrush& brush, double thickness, Qt::PenStyle pen) {
    painter.setPen(QPen(brush, thickness, pen, Qt::RoundCap));
    painter.drawLine(QPointF(from, middle), QPointF(to, middle));
  };
  line(handleRadius + 1, width() - handleRadius - 1, faded(style.grid.darker(plots::isDark(palette()) ? 60 : 112)), 4,
       Qt::SolidLine);
  line(handleRadius + 1, std::min(handle, solved), faded(isEnabled() ? style.curve : style.stale), 4, Qt::SolidLine);
  if (moved) {
    line(std::min(handle, solved), std::max(handle, solved), style.prediction, 4, Qt::SolidLine);
    painter.setPen(QPen(style.mutedText, 2));
    painter.drawLine(QPointF(solved, middle - 6), QPointF(solved, middle + 6));
  }
  paintPlan(painter, style.prediction);
  const QColor ring = moved ? style.prediction : style.curve;
  painter.setPen(QPen(isEnabled() ? ring : style.stale, 2));
  painter.setBrush(style.background);
  painter.drawEllipse(QPointF(handle, middle), handleRadius - 1, handleRadius - 1);
  if (hasFocus()) {
    QColor halo = ring;
    halo.setAlpha(80);
    painter.setPen(QPen(halo, 3));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(QPointF(handle, middle), handleRadius + 2, handleRadius + 2);
  }
}

void ParameterSlider::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  setFocus(Qt::MouseFocusReason);
  dragging_ = true;
  before_ = value_;
  const double x = event->position().x();
  const double offset = x - positionOf(value_);
  // On the handle it is seized where it was hit; beside it the handle jumps there.
  grip_ = std::abs(offset) <= handleRadius + 2 ? offset : 0;
  if (grip_ == 0 && offset != 0) {
    put(valueAt(x));
    Q_EMIT dragged(value_);
  }
}

void ParameterSlider::mouseMoveEvent(QMouseEvent* event) {
  if (!dragging_) return;
  put(valueAt(event->position().x() - grip_));
  Q_EMIT dragged(value_);
}

void ParameterSlider::mouseReleaseEvent(QMouseEvent* event) {
  if (!dragging_ || event->button() != Qt::LeftButton) return;
  dragging_ = false;
  if (value_ == before_) {
    Q_EMIT dragCancelled();
    return;
  }
  Q_EMIT committed(value_, false);
}

void ParameterSlider::keyPressEvent(QKeyEvent* event) {
  if (dragging_) {
    if (event->key() != Qt::Key_Escape) return;
    dragging_ = false;
    put(before_);
    Q_EMIT dragCancelled();
    return;
  }
  double step = (maximum_ - minimum_) / 100;
  if (event->modifiers() & Qt::ShiftModifier) step /= 10;
  double value = value_;
  switch (event->key()) {
    case Qt::Key_Left:
    case Qt::Key_Down: value -= step; break;
    case Qt::Key_Right:
    case Qt::Key_Up: value += step; break;
    case Qt::Key_Home: value = minimum_; break;
    case Qt::Key_End: value = maximum_; break;
    default: event->ignore(); return;
  }
  put(std::clamp(value, minimum_, maximum_));
  Q_EMIT committed(value_, true);
}

void ParameterSlider::wheelEvent(QWheelEvent* event) { event->ignore(); }

}  // namespace pliant::panels
