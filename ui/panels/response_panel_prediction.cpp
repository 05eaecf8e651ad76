#include "ui/jobs/node_correspondence.hpp"
#include "ui/panels/response_overlays.hpp"
#include "ui/panels/response_panel.hpp"

namespace pliant::panels {

using document::StudyStatus;

/// A curve that is traced anew grows over what was predicted for it.
void ResponsePanel::followCurve() {
  const document::StudyState& study = *document_.study(study_);
  if (study.status == StudyStatus::running || study.status == StudyStatus::waiting) return;
  predictor_.setCurve(std::dynamic_pointer_cast<const scene::HarmonicResult>(study.result), study.solvedScene);
}

/// Of the path lengths of probes, whose derivatives are found with the curve.
void ResponsePanel::refreshPredictedCurve() {
  std::optional<jobs::PredictedCurve> predicted;
  if (const auto model = predictor_.model(); model && session_.measure() == jobs::AmplitudeMeasure::pathLength)
    predicted =
        predictor_.predict(probeOf(*model, jobs::correspondingNode(*document_.model(), session_.node(), *model)));
  if (!predicted) {
    plot_->setPredictedCurve(std::nullopt);
    return;
  }
  plots::PredictedResponse response;
  for (const jobs::PredictedCurve::Place& place : predicted->points) {
    response.curve.omega.push_back(place.omega);
    response.curve.amplitude.push_back(place.pathLength);
  }
  response.curve.branches = std::move(predicted->branches);
  for (const jobs::PredictedCurve::Place& peak : predicted->peaks)
    response.peaks.push_back({peak.omega, peak.pathLength});
  plot_->setPredictedCurve(std::move(response));
}

}  // namespace pliant::panels
