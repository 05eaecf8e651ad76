#include <algorithm>
#include <cmath>

#include "ui/plots/response_plot_parts.hpp"
#include "ui/plots/smooth_path.hpp"

namespace pliant::plots {

namespace {

constexpr int pointsBetween = 7;       // two computed ones
constexpr qsizetype manyPoints = 500;  // smooth as they are

void fill(QCPCurve* into, const ResponseCurve& curve, double perOmega, double perMetre) {
  QVector<QPointF> points;
  for (std::size_t i = 0; i < curve.omega.size(); ++i)
    points.push_back({curve.omega[i] * perOmega, curve.amplitude[i] * perMetre});
  const QVector<QPointF> path = smoothPath(points, points.size() > manyPoints ? 0 : pointsBetween);
  QVector<double> t(path.size()), keys(path.size()), values(path.size());
  for (qsizetype i = 0; i < path.size(); ++i) {
    t[i] = static_cast<double>(i);
    keys[i] = path[i].x();
    values[i] = path[i].y();
  }
  into->setData(t, keys, values, true);
}

void fillPoint(QCPCurve* into, const std::optional<ResponsePlace>& place, double perOmega, double perMetre) {
  if (place)
    into->setData({place->omega * perOmega}, {place->amplitude * perMetre});
  else
    into->data()->clear();
}

}  // namespace

QString landmarkName(harmonic::PointKind kind) {
  switch (kind) {
    case harmonic::PointKind::regular: return {};
    case harmonic::PointKind::fold: return ResponsePlot::tr("fold");
    case harmonic::PointKind::peak: return ResponsePlot::tr("peak");
    case harmonic::PointKind::branchPoint: return ResponsePlot::tr("branch point");
    case harmonic::PointKind::periodDoubling: return ResponsePlot::tr("period doubling");
    case harmonic::PointKind::neimarkSacker: return ResponsePlot::tr("Neimark-Sacker");
  }
  return {};
}

void ResponsePlot::redrawCurves() {
  Parts& p = *parts_;
  enlargeToFit();
  const double perOmega = frequencyFactor();
  const double perMetre = p.unit.perMetre;
  const bool faded = p.stale && p.status != document::StudyStatus::running;

  fill(p.earlier, p.earlierCurve, perOmega, perMetre);
  while (p.others.size() + 1 < p.curves.size()) {
    auto* curve = new QCPCurve(p.plot->xAxis, p.plot->yAxis);
    curve->setAntialiased(true);
    p.others.push_back(curve);
  }
  for (QCPCurve* curve : p.others) curve->data()->clear();
  std::size_t other = 0;
  p.selected->data()->clear();
  for (int i = 0; i < static_cast<int>(p.curves.size()); ++i) {
    QCPCurve* curve = i == p.selectedCurve ? p.selected : p.others[other++];
    fill(curve, p.curves[i], perOmega, perMetre);
    if (curve != p.selected) curve->setPen(QPen(faded ? p.style.grid : p.style.otherCurve, 1));
  }
  p.selected->setPen(QPen(faded ? p.style.stale : p.style.curve, faded ? 1.5 : 2));

  for (Landmark& landmark : p.landmarks) p.plot->removeItem(landmark.label);
  p.landmarks.clear();
  ResponseCurve folds, peaks;
  if (const ResponseCurve* curve = p.curve()) {
    for (std::size_t i = 0; i < curve->omega.size(); ++i) {
      const auto kind = i < curve->kinds.size() ? curve->kinds[i] : harmonic::PointKind::regular;
      if (kind == harmonic::PointKind::regular) continue;
      const bool peak = kind == harmonic::PointKind::peak;
      ResponseCurve& into = peak ? peaks : folds;
      into.omega.push_back(curve->omega[i]);
      into.amplitude.push_back(curve->amplitude[i]);
      auto* label = new QCPItemText(p.plot);
      label->setSelectable(false);
      QFont small = font();
      small.setPointSizeF(font().pointSizeF() * 0.85);
      label->setFont(small);
      label->setColor(faded ? p.style.mutedText : peak ? p.style.text : p.style.mutedText);
      const QString frequency = formatFrequency(curve->omega[i], p.hertz);
      p.landmarks.push_back(
          {curve->omega[i], curve->amplitude[i], peak, landmarkName(kind) + QStringLiteral(" ") + frequency, label});
    }
  }
  fill(p.folds, folds, perOmega, perMetre);
  fill(p.peaks, peaks, perOmega, perMetre);
  updateAxisLabels();
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
  p.plot->replot(QCustomPlot::rpQueuedReplot);
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
  std::vector<QRectF> taken;
  if (p.chip->isVisible()) taken.push_back(QRectF(p.chip->geometry()).adjusted(-8, -4, 8, 4));
  const auto keepClear = [&](const std::optional<ResponsePlace>& place, double width) {
    if (!place) return;
    taken.emplace_back(p.plot->xAxis->coordToPixel(place->omega * frequencyFactor()) - 10,
                       p.plot->yAxis->coordToPixel(place->amplitude * p.unit.perMetre) - 10, width, 20);
  };
  keepClear(p.shownPlace, 20);
  keepClear(p.predictedPlace, 20);
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
}

}  // namespace pliant::plots
