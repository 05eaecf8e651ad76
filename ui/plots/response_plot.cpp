#include "ui/plots/response_plot.hpp"

#include <QEvent>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/plots/response_plot_parts.hpp"

namespace pliant::plots {

namespace {
constexpr double smallestOfLogarithmicAxis = 1e-9;  // of the largest amplitude
}

ResponsePlot::ResponsePlot(QWidget* parent) : QWidget(parent), parts_(std::make_unique<Parts>()) {
  build();
  applyStyle();
  setEmptyState(tr("No frequency response yet."), {});
}

ResponsePlot::~ResponsePlot() = default;

double ResponsePlot::frequencyFactor() const { return parts_->hertz ? 1 / (2 * std::numbers::pi) : 1.0; }

void ResponsePlot::setFrequencyRange(double from, double to) {
  Parts& p = *parts_;
  if (from > to) std::swap(from, to);
  if (p.from == from && p.to == to) return;
  p.from = from;
  p.to = to;
  if (!p.zoomed) fit();
}

void ResponsePlot::setCurves(std::vector<ResponseCurve> curves, int selected, document::StudyStatus status, bool stale,
                             const QString& note) {
  Parts& p = *parts_;
  const ResponseCurve* before = p.curve();
  const bool wasRunning = p.status == document::StudyStatus::running;
  const bool begins = status == document::StudyStatus::running && !wasRunning;
  if (begins && before && before->omega.size() > 1) p.earlierCurve = *before;
  if (status != document::StudyStatus::running && status != document::StudyStatus::waiting) p.earlierCurve = {};
  const bool otherNode = before && selected < static_cast<int>(curves.size()) && before->name != curves[selected].name;
  if (otherNode) p.earlierCurve = {};
  p.curves = std::move(curves);
  p.selectedCurve = selected;
  p.status = status;
  p.stale = stale;
  p.note = note;
  const bool empty = p.curves.empty() && p.earlierCurve.omega.empty() && status != document::StudyStatus::running;
  p.pages->setCurrentWidget(empty ? p.emptyPage : static_cast<QWidget*>(p.plot));
  // Once the curve is whole, the room left for its growth is given back.
  const bool ends = wasRunning && status != document::StudyStatus::running;
  if ((otherNode || ends) && !p.zoomed) p.top = 0;
  redrawCurves();
  redrawMarkers();
  updateChip();
}

void ResponsePlot::clear() {
  Parts& p = *parts_;
  p.earlierCurve = {};
  p.shownPlace.reset();
  p.predictedPlace.reset();
  p.predictedResponse.reset();
  p.top = 0;
  p.zoomed = false;
  p.curves.clear();
  p.status = document::StudyStatus::none;
  setCurves({}, 0, document::StudyStatus::none, false, {});
}

void ResponsePlot::setEmptyState(const QString& sentence, const QString& action) {
  parts_->emptyText->setText(sentence);
  parts_->emptyAction->setText(action);
  parts_->emptyAction->setVisible(!action.isEmpty());
}

void ResponsePlot::setAmplitudeLabel(const QString& label) {
  if (parts_->amplitudeLabel == label) return;
  parts_->amplitudeLabel = label;
  if (!parts_->zoomed) parts_->top = 0;
  updateAxisLabels();
}

void ResponsePlot::setHertz(bool hertz) {
  if (parts_->hertz == hertz) return;
  const double before = frequencyFactor();
  const QCPRange range = parts_->plot->xAxis->range();
  parts_->hertz = hertz;
  const double change = frequencyFactor() / before;
  parts_->plot->xAxis->setRange(range.lower * change, range.upper * change);
  redrawCurves();
  redrawMarkers();
  updateChip();
}

bool ResponsePlot::isHertz() const { return parts_->hertz; }

void ResponsePlot::setShownMotion(std::optional<ResponsePlace> place) {
  parts_->shownPlace = place;
  redrawMarkers();
}

void ResponsePlot::setPrediction(std::optional<ResponsePlace> place) {
  parts_->predictedPlace = place;
  redrawMarkers();
}

void ResponsePlot::setPredictedCurve(std::optional<PredictedResponse> curve) {
  if (!curve && !parts_->predictedResponse) return;
  parts_->predictedResponse = std::move(curve);
  redrawMarkers();
}

const std::optional<PredictedResponse>& ResponsePlot::predictedCurve() const { return parts_->predictedResponse; }

void ResponsePlot::enlargeToFit() {
  Parts& p = *parts_;
  double largest = 0;
  const auto look = [&](const ResponseCurve& curve) {
    for (const double amplitude : curve.amplitude)
      if (std::isfinite(amplitude)) largest = std::max(largest, amplitude);
  };
  for (const ResponseCurve& curve : p.curves) look(curve);
  look(p.earlierCurve);
  if (p.shownPlace) largest = std::max(largest, p.shownPlace->amplitude);
  if (p.predictedPlace) largest = std::max(largest, p.predictedPlace->amplitude);
  if (p.predictedResponse) {
    const double most = 2 * largest;
    for (const double amplitude : p.predictedResponse->curve.amplitude)
      largest = std::max(largest, std::min(amplitude, most));
  }
  if (!(largest > 0)) return;
  // Headroom for the labels above the peaks; while the curve grows one jump has to last for a while.
  const bool grows = p.status == document::StudyStatus::running;
  if (largest * 1.12 <= p.top && p.top > 0) return;
  p.top = roundedUp(largest * (grows ? 1.6 : 1.2));
  const LengthUnit unit = fittingLengthUnit(p.top);
  const double change = unit.perMetre / p.unit.perMetre;
  const bool rescale = unit.name != p.unit.name;
  p.unit = unit;
  if (!p.zoomed) {
    fitAmplitudes();
  } else if (rescale) {
    const QCPRange range = p.plot->yAxis->range();
    p.plot->yAxis->setRange(range.lower * change, range.upper * change);
  }
}

/// The range of amplitudes up to `top`; on a logarithmic axis from the smallest one.
void ResponsePlot::fitAmplitudes() {
  Parts& p = *parts_;
  double bottom = 0;
  if (p.logarithmic) {
    bottom = p.top;
    for (const ResponseCurve& curve : p.curves)
      for (const double amplitude : curve.amplitude)
        if (amplitude > p.top * smallestOfLogarithmicAxis) bottom = std::min(bottom, amplitude);
    bottom /= 1.5;
  }
  p.plot->yAxis->setRange(bottom * p.unit.perMetre, p.top * p.unit.perMetre);
}

void ResponsePlot::setLogarithmic(bool logarithmic) {
  Parts& p = *parts_;
  if (p.logarithmic == logarithmic) return;
  p.logarithmic = logarithmic;
  p.plot->yAxis->setScaleType(logarithmic ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
  p.plot->yAxis->setTicker(logarithmic ? QSharedPointer<QCPAxisTicker>(new QCPAxisTickerLog)
                                       : QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
  p.plot->yAxis->ticker()->setTickCount(4);
  fit();
}

QCustomPlot* ResponsePlot::plot() const { return parts_->plot; }

void ResponsePlot::setOverlays(std::vector<ResponseOverlay> overlays) {
  parts_->overlays = std::move(overlays);
  redrawOverlays();
  parts_->plot->replot(QCustomPlot::rpQueuedReplot);
}

const std::vector<ResponseOverlay>& ResponsePlot::overlays() const { return parts_->overlays; }

void ResponsePlot::fit() {
  Parts& p = *parts_;
  p.zoomed = false;
  p.top = 0;
  const double factor = frequencyFactor();
  double from = p.from, to = p.to;
  for (const ResponseCurve& curve : p.curves)
    for (const double omega : curve.omega) {
      if (!(to > from)) from = to = omega;
      from = std::min(from, omega);
      to = std::max(to, omega);
    }
  const double margin = to > from ? 0.02 * (to - from) : 1;
  p.plot->xAxis->setRange((from - margin) * factor, (to + margin) * factor);
  redrawCurves();
  redrawMarkers();
}

void ResponsePlot::updateAxisLabels() {
  Parts& p = *parts_;
  p.plot->xAxis->setLabel(p.hertz ? tr("Frequency of the drive  [Hz]") : tr("Frequency of the drive  ω  [rad/s]"));
  const QString label = p.amplitudeLabel.isEmpty() ? tr("Amplitude") : p.amplitudeLabel;
  p.plot->yAxis->setLabel(QStringLiteral("%1  [%2]").arg(label, p.unit.name));
  p.plot->replot(QCustomPlot::rpQueuedReplot);
}

QPointF ResponsePlot::positionOf(const ResponsePlace& place) const {
  const Parts& p = *parts_;
  const QPointF pixel(p.plot->xAxis->coordToPixel(place.omega * frequencyFactor()),
                      p.plot->yAxis->coordToPixel(place.amplitude * p.unit.perMetre));
  return p.plot->mapTo(this, pixel);
}

double ResponsePlot::largestFrequencyShown() const { return parts_->plot->xAxis->range().upper / frequencyFactor(); }

double ResponsePlot::largestAmplitudeShown() const {
  return parts_->plot->yAxis->range().upper / parts_->unit.perMetre;
}

QString ResponsePlot::statusText() const { return parts_->chip->text(); }

std::optional<ResponsePlace> ResponsePlot::shownMotion() const { return parts_->shownPlace; }

std::optional<ResponsePlace> ResponsePlot::prediction() const { return parts_->predictedPlace; }

int ResponsePlot::pointCount() const {
  const ResponseCurve* curve = parts_->curve();
  return curve ? static_cast<int>(curve->omega.size()) : 0;
}

void ResponsePlot::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) applyStyle();
}

void ResponsePlot::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  updateChip();
}

}  // namespace pliant::plots
