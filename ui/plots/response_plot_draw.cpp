#include <QTimer>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ui/plots/response_plot_parts.hpp"
#include "ui/plots/smooth_path.hpp"

namespace pliant::plots {

namespace {

constexpr qsizetype manyPoints = 500;  // smooth as they are

/// Okabe and Ito's colours that the study's own curves leave.
constexpr std::array<QRgb, 5> overlayColors{0xffd55e00, 0xff009e73, 0xffcc79a7, 0xff8a6d00, 0xff56b4e9};

void fillPoint(QCPCurve* into, const std::optional<ResponsePlace>& place, double perOmega, double perMetre) {
  if (place)
    into->setData({place->omega * perOmega}, {place->amplitude * perMetre});
  else
    into->data()->clear();
}

}  // namespace

void fillCurve(QCPCurve* into, const ResponseCurve& curve, double perOmega, double perMetre, int mostBetween,
               QCPCurve* unstable) {
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  const std::size_t count = curve.omega.size();
  const auto isUnstable = [&](std::size_t point) {
    return unstable && point < curve.unstable.size() && curve.unstable[point];
  };
  QVector<double> t, keys, stableValues, unstableValues;
  const auto append = [&](const QPointF& place, bool drawStable, bool drawUnstable) {
    t.push_back(static_cast<double>(t.size()));
    keys.push_back(place.x());
    stableValues.push_back(drawStable ? place.y() : gap);
    unstableValues.push_back(drawUnstable ? place.y() : gap);
  };
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    QVector<QPointF> points;
    for (end = begin; end < count && (curve.branches.empty() || curve.branches[end] == curve.branches[begin]); ++end)
      points.push_back({curve.omega[end] * perOmega, curve.amplitude[end] * perMetre});
    const int between = points.size() > manyPoints ? 0 : mostBetween;
    const QVector<QPointF> path = smoothPath(points, between);
    for (qsizetype i = 0; i < path.size(); ++i) {
      // The pieces that meet here; a piece is unstable if one of the computed points at its ends is.
      const std::size_t point = begin + static_cast<std::size_t>(i / (between + 1));
      const bool onPoint = i % (between + 1) == 0;
      const bool after = isUnstable(point) || (point + 1 < end && isUnstable(point + 1));
      const bool before = onPoint && point > begin ? isUnstable(point - 1) || isUnstable(point) : after;
      append(path[i], !before || !after, before || after);
    }
    if (!path.isEmpty()) append(path.back(), false, false);
  }
  into->setData(t, keys, stableValues, true);
  if (unstable) unstable->setData(t, keys, unstableValues, true);
}

void ResponsePlot::redrawCurves() {
  Parts& p = *parts_;
  p.outdated = true;
  enlargeToFit();
  const double perOmega = frequencyFactor();
  const double perMetre = p.unit.perMetre;
  const bool faded = p.stale && p.status != document::StudyStatus::running;

  fillCurve(p.earlier, p.earlierCurve, perOmega, perMetre);
  while (p.others.size() + 1 < p.curves.size()) {
    auto* curve = new QCPCurve(p.plot->xAxis, p.plot->yAxis);
    curve->setAntialiased(true);
    p.others.push_back(curve);
  }
  for (QCPCurve* curve : p.others) curve->data()->clear();
  std::size_t other = 0;
  p.selected->data()->clear();
  p.unstable->data()->clear();
  for (int i = 0; i < static_cast<int>(p.curves.size()); ++i) {
    QCPCurve* curve = i == p.selectedCurve ? p.selected : p.others[other++];
    fillCurve(curve, p.curves[i], perOmega, perMetre, smoothPointsBetween, curve == p.selected ? p.unstable : nullptr);
    if (curve != p.selected) curve->setPen(QPen(faded ? p.style.grid : p.style.otherCurve, 1));
  }
  p.selected->setPen(QPen(faded ? p.style.stale : p.style.curve, faded ? 1.5 : 2));
  QPen dashes = p.selected->pen();
  dashes.setDashPattern({4, 3});
  p.unstable->setPen(dashes);
  redrawOverlays();

  for (Landmark& landmark : p.landmarks) p.plot->removeItem(landmark.label);
  p.landmarks.clear();
  ResponseCurve folds, peaks, bifurcations;
  if (const ResponseCurve* curve = p.curve()) {
    for (std::size_t i = 0; i < curve->omega.size(); ++i) {
      const auto kind = i < curve->kinds.size() ? curve->kinds[i] : harmonic::PointKind::regular;
      if (kind == harmonic::PointKind::regular) continue;
      const bool peak = kind == harmonic::PointKind::peak;
      ResponseCurve& into = peak ? peaks : kind == harmonic::PointKind::fold ? folds : bifurcations;
      into.omega.push_back(curve->omega[i]);
      into.amplitude.push_back(curve->amplitude[i]);
      auto* label = new QCPItemText(p.plot);
      label->setSelectable(false);
      label->setLayer(p.markers);
      QFont small = font();
      small.setPointSizeF(font().pointSizeF() * 0.85);
      label->setFont(small);
      label->setColor(faded ? p.style.mutedText : peak ? p.style.text : p.style.mutedText);
      const QString text = kindName(kind) + ' ' + formatFrequency(curve->omega[i], p.hertz);
      p.landmarks.push_back({curve->omega[i], curve->amplitude[i], peak, text, label});
    }
  }
  fillCurve(p.folds, folds, perOmega, perMetre, 0);
  fillCurve(p.peaks, peaks, perOmega, perMetre, 0);
  fillCurve(p.bifurcations, bifurcations, perOmega, perMetre, 0);
  updateAxisLabels();
}

void ResponsePlot::redrawOverlays() {
  Parts& p = *parts_;
  p.outdated = true;
  for (QCPCurve* curve : p.overlayCurves) p.plot->removePlottable(curve);
  p.overlayCurves.clear();
  p.plot->legend->clearItems();
  for (std::size_t i = 0; i < p.overlays.size(); ++i) {
    const ResponseOverlay& overlay = p.overlays[i];
    const QColor color(overlayColors[i % overlayColors.size()]);
    auto* curve = new QCPCurve(p.plot->xAxis, p.plot->yAxis);
    curve->setAntialiased(true);
    curve->setSelectable(QCP::stNone);
    curve->setName(overlay.name);
    curve->setPen(QPen(color, 1.5));
    if (overlay.dots) {
      curve->setLineStyle(QCPCurve::lsNone);
      curve->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(color, 1.5), p.style.background, 7));
    }
    ResponseCurve drawn;
    drawn.omega = overlay.omega;
    drawn.amplitude = overlay.amplitude;
    fillCurve(curve, drawn, frequencyFactor(), p.unit.perMetre, overlay.dots ? 0 : smoothPointsBetween);
    curve->addToLegend();
    p.overlayCurves.push_back(curve);
  }
  p.plot->legend->setVisible(!p.overlays.empty());
}

void ResponsePlot::redrawMarkers() {
  Parts& p = *parts_;
  const double before = p.unit.perMetre;
  enlargeToFit();
  if (p.unit.perMetre != before) redrawCurves();
  const double perOmega = frequencyFactor();
  const double perMetre = p.unit.perMetre;
  fillPoint(p.shown, p.shownPlace, perOmega, perMetre);
  fillPoint(p.predicted, p.predictedPlace, perOmega, perMetre);
  p.step->data()->clear();
  p.predictedLabel->setVisible(p.predictedPlace.has_value());
  if (p.predictedPlace) {
    const double x = p.predictedPlace->omega * perOmega;
    const double y = p.predictedPlace->amplitude * perMetre;
    if (p.shownPlace) p.step->setData({p.shownPlace->omega * perOmega, x}, {p.shownPlace->amplitude * perMetre, y});
    p.predictedLabel->setPadding(QMargins(4, 1, 4, 1));
    p.predictedLabel->setText(tr("predicted %1").arg(formatLength(p.predictedPlace->amplitude)));
  }
  redrawPredictedCurve();
  const bool cursor = p.draggingCursor || p.shownPlace.has_value();
  p.cursor->setVisible(cursor);
  p.cursorLabel->setVisible(p.draggingCursor);
  if (cursor) {
    const double omega = p.draggingCursor ? p.cursorOmega : p.shownPlace->omega;
    const double x = omega * perOmega;
    p.cursor->point1->setCoords(x, 0);
    p.cursor->point2->setCoords(x, 1);
    QColor color = p.style.shown;
    if (!p.draggingCursor) color.setAlpha(96);
    p.cursor->setPen(QPen(color, 1.5));
    p.cursorLabel->position->setCoords(x, 0.0);
    p.cursorLabel->setText(QStringLiteral("ω = %1").arg(formatFrequency(omega, p.hertz)));
  }
  replotMarkers();
}

/// Only the markers, once the events at hand are done, unless the rest has changed as well.
void ResponsePlot::replotMarkers() {
  Parts& p = *parts_;
  if (p.outdated || p.drawnRanges != std::array{p.plot->xAxis->range(), p.plot->yAxis->range()}) {
    p.plot->replot(QCustomPlot::rpQueuedReplot);
    return;
  }
  if (p.markersQueued) return;
  p.markersQueued = true;
  QTimer::singleShot(0, this, [this] {
    parts_->markersQueued = false;
    placeLabels();
    parts_->markers->replot();
  });
}

/// The predicted amplitude right of its marker. Peaks first, from the highest down; a label that would cover an earlier
/// one is left out.
void ResponsePlot::placeLabels() {
  Parts& p = *parts_;
  QRectF predictedText;
  if (p.predictedPlace) {
    const QPointF marker(p.plot->xAxis->coordToPixel(p.predictedPlace->omega * frequencyFactor()),
                         p.plot->yAxis->coordToPixel(p.predictedPlace->amplitude * p.unit.perMetre));
    // On the side where it hides less of the curve.
    const QSizeF size = QFontMetricsF(p.predictedLabel->font()).size(0, p.predictedLabel->text()) + QSizeF(8, 2);
    const auto hidden = [&](double left) {
      const QRectF rect(QPointF(left, marker.y() - size.height() / 2), size);
      if (!QRectF(p.plot->axisRect()->rect()).contains(rect)) return 1'000'000;
      int count = 0;
      for (const ResponseCurve* curve : {p.curve(), static_cast<const ResponseCurve*>(&p.earlierCurve)})
        for (std::size_t k = 0; curve && k < curve->omega.size(); ++k)
          count += rect.contains(p.plot->xAxis->coordToPixel(curve->omega[k] * frequencyFactor()),
                                 p.plot->yAxis->coordToPixel(curve->amplitude[k] * p.unit.perMetre));
      return count;
    };
    const double right = marker.x() + 12, left = marker.x() - 12 - size.width();
    p.predictedLabel->position->setType(QCPItemPosition::ptAbsolute);
    p.predictedLabel->position->setCoords(hidden(right) <= hidden(left) ? right : left, marker.y());
    predictedText = QRectF(p.predictedLabel->position->coords() - QPointF(0, size.height() / 2), size);
  }
  std::vector<Landmark*> order;
  for (Landmark& landmark : p.landmarks) order.push_back(&landmark);
  std::stable_sort(order.begin(), order.end(), [](const Landmark* a, const Landmark* b) {
    return a->peak != b->peak ? a->peak : a->amplitude > b->amplitude;
  });
  for (Landmark& landmark : p.predictedLandmarks)
    if (!landmark.text.isEmpty()) order.push_back(&landmark);
  std::vector<QRectF> taken;
  if (p.chip->isVisible()) taken.push_back(QRectF(p.chip->geometry()).adjusted(-8, -4, 8, 4));
  const auto keepClear = [&](const std::optional<ResponsePlace>& place, double reach) {
    if (!place) return;
    taken.emplace_back(p.plot->xAxis->coordToPixel(place->omega * frequencyFactor()) - reach,
                       p.plot->yAxis->coordToPixel(place->amplitude * p.unit.perMetre) - reach, 2 * reach, 2 * reach);
  };
  keepClear(p.shownPlace, 10);
  keepClear(p.predictedPlace, 10);
  for (const InsetItem& inset : p.insets) keepClear(inset.place, 6);  // where leaders begin
  for (const Landmark* landmark : order)
    if (landmark->peak) keepClear(ResponsePlace{landmark->omega, landmark->amplitude}, 5);
  if (p.predictedPlace) taken.push_back(predictedText);
  const QRectF frame = p.plot->axisRect()->rect();
  for (Landmark* landmark : order) {
    const QPointF at(p.plot->xAxis->coordToPixel(landmark->omega * frequencyFactor()),
                     p.plot->yAxis->coordToPixel(landmark->amplitude * p.unit.perMetre));
    const QSizeF size = QFontMetricsF(landmark->label->font()).size(0, landmark->text) + QSizeF(4, 2);
    // Above a peak; beside a fold, where the curve has no branch.
    const QRectF above(at.x() - size.width() / 2, at.y() - 10 - size.height(), size.width(), size.height());
    const QRectF right(at.x() + 10, at.y() - size.height() / 2, size.width(), size.height());
    const QRectF left(at.x() - 10 - size.width(), at.y() - size.height() / 2, size.width(), size.height());
    const std::vector<QRectF> candidates =
        landmark->peak ? std::vector{above, right, left} : std::vector{right, left, above};
    const auto isFree = [&](const QRectF& rect) {
      return frame.contains(rect) &&
             std::none_of(taken.begin(), taken.end(), [&](const QRectF& other) { return other.intersects(rect); });
    };
    const auto place = std::find_if(candidates.begin(), candidates.end(), isFree);
    landmark->label->setVisible(place != candidates.end());
    if (place == candidates.end()) continue;
    taken.push_back(*place);
    landmark->label->setPositionAlignment(Qt::AlignCenter);
    landmark->label->position->setType(QCPItemPosition::ptAbsolute);
    landmark->label->position->setCoords(place->center());
    landmark->label->setText(landmark->text);
  }
  placeInsets(taken);
}

}  // namespace pliant::plots
