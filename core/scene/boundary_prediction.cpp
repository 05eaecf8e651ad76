#include "core/scene/boundary_prediction.hpp"

#include <utility>

namespace pliant::scene {

BoundaryPrediction::BoundaryPrediction(const Scene& scene, std::shared_ptr<const StretchBoundaryResult> result,
                                       base::ExecutionContext& context)
    : result_(std::move(result)),
      cellIndex_(scene::cellIndex(scene, result_->provenance.options["cell"])),
      entry_(scene.normalized()["interlocking_cells"][cellIndex_]) {
  // A composed material has a number for every coordinate.
  if (entry_["type"] == "composed") return;
  const auto all = cellParameters(scene, cellIndex_);
  auto rates = cellRates(cellFunction(scene, cellIndex_, all), all, valuesOf(all));
  std::vector<interlock::CellRate> known;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (rates[i]) {
      parameters_.push_back(all[i]);
      known.push_back(std::move(*rates[i]));
    }
  interlock::EquilibriumOptions options;
  options.finalGap = result_->provenance.options["final_gap"];
  const interlock::CellSolver solver(*result_->cell, options);
  sensitivity_ = interlock::boundarySensitivity(solver, result_->boundary, known, context);
}

std::shared_ptr<const StretchBoundaryResult> BoundaryPrediction::predict(const Json& entry) const {
  if (sensitivity_.termination != base::TerminationType::converged) return nullptr;
  Json others = entry;
  Eigen::VectorXd change(static_cast<Eigen::Index>(parameters_.size()));
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const auto value = entry.find(parameters_[i].name);
    if (value == entry.end()) return nullptr;
    change[static_cast<Eigen::Index>(i)] = value->get<double>() - parameters_[i].value;
    others[parameters_[i].name] = parameters_[i].value;
  }
  if (others != entry_ || change.isZero(0)) return nullptr;
  auto predicted = std::make_shared<StretchBoundaryResult>(*result_);
  predicted->boundary = interlock::predictedBoundary(result_->boundary, sensitivity_, change);
  return predicted;
}

}  // namespace pliant::scene
