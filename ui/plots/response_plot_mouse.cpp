#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include "ui/plots/response_plot_parts.hpp"

namespace pliant::plots {

namespace {
constexpr double clickRadius = 14;  ///< device-independent pixels
constexpr double cursorRadius = 6;
constexpr double dragDistance = 4;
}  // namespace

std::pair<int, double> ResponsePlot::nearestPoint(const QPointF& pixel, double across) const {
  const Parts& p = *parts_;
  std::pair<int, double> best{-1, 0};
  const ResponseCurve* curve = p.curve();
  if (!curve) return best;
  const double factor = frequencyFactor();
  for (int i = 0; i < static_cast<int>(curve->omega.size()); ++i) {
    const double dx = p.plot->xAxis->coordToPixel(curve->omega[i] * factor) - pixel.x();
    const double dy = p.plot->yAxis->coordToPixel(curve->amplitude[i] * p.unit.perMetre) - pixel.y();
    const double distance = std::hypot(dx, across * dy);
    if (best.first < 0 || distance < best.second) best = {i, distance};
  }
  return best;
}

bool ResponsePlot::isOnCursor(const QPointF& pixel) const {
  const Parts& p = *parts_;
  if (!p.shownPlace || !p.plot->axisRect()->rect().contains(pixel.toPoint())) return false;
  return std::abs(p.plot->xAxis->coordToPixel(p.shownPlace->omega * frequencyFactor()) - pixel.x()) <= cursorRadius;
}

void ResponsePlot::press(QMouseEvent* event) {
  Parts& p = *parts_;
  if (event->button() != Qt::LeftButton) return;
  p.pressed = true;
  p.pressPosition = event->position();
  p.draggingCursor = isOnCursor(event->position());
  // Panning and the cursor share the button: whoever was hit first keeps it.
  p.plot->setInteraction(QCP::iRangeDrag, !p.draggingCursor);
  p.cursorPoint = -1;
}

void ResponsePlot::move(QMouseEvent* event) {
  Parts& p = *parts_;
  if (p.draggingCursor) {
    if (p.cursorPoint >= 0 || (event->position() - p.pressPosition).manhattanLength() >= dragDistance)
      dragCursor(event->position());
    return;
  }
  if (p.pressed) {
    if ((event->position() - p.pressPosition).manhattanLength() >= dragDistance) p.zoomed = true;
    return;
  }
  p.plot->setCursor(isOnCursor(event->position()) ? Qt::SplitHCursor : Qt::ArrowCursor);
  readOut(event->position());
}

void ResponsePlot::dragCursor(const QPointF& pixel) {
  Parts& p = *parts_;
  const QRect frame = p.plot->axisRect()->rect();
  const double x = std::clamp(pixel.x(), double(frame.left()), double(frame.right()));
  p.cursorOmega = p.plot->xAxis->pixelToCoord(x) / frequencyFactor();
  const int nearest = nearestPoint({x, pixel.y()}, 0.15).first;
  redrawMarkers();
  if (nearest >= 0 && nearest != p.cursorPoint) {
    p.cursorPoint = nearest;
    Q_EMIT pointChosen(nearest);
  }
}

void ResponsePlot::release(QMouseEvent* event) {
  Parts& p = *parts_;
  if (event->button() != Qt::LeftButton || !p.pressed) return;
  p.pressed = false;
  p.plot->setInteraction(QCP::iRangeDrag, true);
  const bool moved = (event->position() - p.pressPosition).manhattanLength() >= dragDistance;
  if (p.draggingCursor) {
    p.draggingCursor = false;
    redrawMarkers();
    if (moved && p.cursorPoint >= 0) {
      const double computed = p.curves[p.selectedCurve].omega[p.cursorPoint];
      const double pixels = std::abs(p.plot->xAxis->coordToPixel(computed * frequencyFactor()) -
                                     p.plot->xAxis->coordToPixel(p.cursorOmega * frequencyFactor()));
      if (pixels > 2) Q_EMIT frequencyRequested(p.cursorOmega, p.cursorPoint);
      return;
    }
  }
  if (moved) return;
  const auto [index, distance] = nearestPoint(event->position(), 1);
  if (index >= 0 && distance <= clickRadius) Q_EMIT pointChosen(index);
}

QString kindName(harmonic::PointKind kind) {
  using harmonic::PointKind;
  switch (kind) {
    case PointKind::fold: return ResponsePlot::tr("fold");
    case PointKind::peak: return ResponsePlot::tr("peak");
    case PointKind::branchPoint: return ResponsePlot::tr("branch point");
    case PointKind::periodDoubling: return ResponsePlot::tr("period doubling");
    case PointKind::neimarkSacker: return ResponsePlot::tr("Neimark-Sacker");
    case PointKind::regular: break;
  }
  return {};
}

QString ResponsePlot::pointText(int index) const {
  const Parts& p = *parts_;
  const ResponseCurve& curve = p.curves[p.selectedCurve];
  QString kind;
  if (index < static_cast<int>(curve.kinds.size())) kind = kindName(curve.kinds[index]);
  if (!kind.isEmpty()) kind += QStringLiteral(": ");
  const bool unstable = index < static_cast<int>(curve.unstable.size()) && curve.unstable[index];
  return QStringLiteral("%1%2, %3%4")
      .arg(kind, formatFrequency(curve.omega[index], p.hertz), formatLength(curve.amplitude[index]),
           unstable ? tr(", unstable") : QString());
}

void ResponsePlot::readOut(const QPointF& pixel) {
  Parts& p = *parts_;
  const auto [index, distance] = nearestPoint(pixel, 1);
  const bool near = index >= 0 && distance <= clickRadius;
  p.hoverLabel->setVisible(near);
  if (near) {
    const ResponseCurve& curve = p.curves[p.selectedCurve];
    const double x = curve.omega[index] * frequencyFactor();
    const double y = curve.amplitude[index] * p.unit.perMetre;
    p.hover->setData({x}, {y});
    p.hoverLabel->setText(pointText(index));
    const QRectF frame = p.plot->axisRect()->rect();
    const QPointF at(p.plot->xAxis->coordToPixel(x), p.plot->yAxis->coordToPixel(y));
    const double width = QFontMetricsF(p.hoverLabel->font()).horizontalAdvance(p.hoverLabel->text()) + 32;
    const bool flip = at.x() + width > frame.right();
    const bool below = at.y() - 40 < frame.top();
    p.hoverLabel->setPositionAlignment((flip ? Qt::AlignRight : Qt::AlignLeft) |
                                       (below ? Qt::AlignTop : Qt::AlignBottom));
    p.hoverLabel->position->setCoords(at + QPointF(flip ? -8 : 8, below ? 8 : -8));
    Q_EMIT readoutChanged(pointText(index));
  } else {
    p.hover->data()->clear();
    const QRect frame = p.plot->axisRect()->rect();
    if (frame.contains(pixel.toPoint()))
      Q_EMIT readoutChanged(QStringLiteral("%1, %2").arg(
          formatFrequency(p.plot->xAxis->pixelToCoord(pixel.x()) / frequencyFactor(), p.hertz),
          formatLength(std::max(0.0, p.plot->yAxis->pixelToCoord(pixel.y()) / p.unit.perMetre))));
    else
      Q_EMIT readoutChanged({});
  }
  replotMarkers();
}

}  // namespace pliant::plots
