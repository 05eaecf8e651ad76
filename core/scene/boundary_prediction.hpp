#pragma once

#include "core/interlock/boundary_sensitivity.hpp"
#include "core/scene/cell_parameters.hpp"
#include "core/scene/interlock_result.hpp"

namespace pliant::scene {

/// Predicts the boundary of a material whose numbers change, from one that has been solved: for a window that shows it
/// while a slider moves.
class BoundaryPrediction {
 public:
  /// `result` is of this scene, converged; takes about as long as some hundred Newton steps. After cancellation it
  /// predicts nothing.
  BoundaryPrediction(const Scene& scene, std::shared_ptr<const StretchBoundaryResult> result,
                     base::ExecutionContext& context);

  std::size_t cellIndex() const { return cellIndex_; }
  /// The boundary for a normalised entry of "interlocking_cells" at cellIndex. Null if the entry is as it was, or
  /// differs in more than numbers that the geometry follows smoothly, such as a supercell.
  std::shared_ptr<const StretchBoundaryResult> predict(const Json& entry) const;
  /// Limits whose derivatives hold, of all.
  int smoothCount() const { return sensitivity_.count(interlock::LimitSensitivity::Kind::smooth); }

 private:
  std::shared_ptr<const StretchBoundaryResult> result_;
  std::size_t cellIndex_;
  Json entry_;  ///< normalised
  std::vector<CellParameter> parameters_;
  interlock::BoundarySensitivity sensitivity_;
};

}  // namespace pliant::scene
