#include <algorithm>

#include "ui/plots/response_plot_parts.hpp"

namespace pliant::plots {

void ResponsePlot::redrawPredictedCurve() {
  Parts& p = *parts_;
  for (Landmark& landmark : p.predictedLandmarks) {
    landmark.text.clear();
    landmark.label->setVisible(false);
  }
  p.predictedCurve->data()->clear();
  p.predictedPeaks->data()->clear();
  if (!p.predictedResponse) return;
  const ResponseCurve& curve = p.predictedResponse->curve;
  fillCurve(p.predictedCurve, curve, frequencyFactor(), p.unit.perMetre);
  std::vector<ResponsePlace> places = p.predictedResponse->peaks;
  ResponseCurve peaks;
  for (const ResponsePlace& peak : places) {
    peaks.omega.push_back(peak.omega);
    peaks.amplitude.push_back(peak.amplitude);
  }
  fillCurve(p.predictedPeaks, peaks, frequencyFactor(), p.unit.perMetre, 0);
  // Where no peak is known, the highest point says what the dashes are.
  const bool any = !places.empty();
  if (!any && !curve.omega.empty()) {
    const auto highest = std::max_element(curve.amplitude.begin(), curve.amplitude.end());
    places.push_back({curve.omega[static_cast<std::size_t>(highest - curve.amplitude.begin())], *highest});
  }
  std::stable_sort(
      places.begin(), places.end(), [](const auto& a, const auto& b) { return a.amplitude > b.amplitude; });
  QFont small = font();
  small.setPointSizeF(font().pointSizeF() * 0.85);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i == p.predictedLandmarks.size()) {
      auto* label = new QCPItemText(p.plot);
      label->setSelectable(false);
      label->setLayer(p.markers);
      p.predictedLandmarks.push_back({.peak = true, .label = label});
    }
    Landmark& landmark = p.predictedLandmarks[i];
    landmark.omega = places[i].omega;
    landmark.amplitude = places[i].amplitude;
    landmark.text = any ? tr("predicted peak %1").arg(formatFrequency(places[i].omega, p.hertz)) : tr("predicted");
    landmark.label->setFont(small);
    landmark.label->setColor(p.style.prediction);
  }
}

}  // namespace pliant::plots
