#pragma once

#include <QObject>
#include <memory>

#include "core/scene/boundary_prediction.hpp"
#include "ui/document/document.hpp"
#include "ui/jobs/cell_inspector.hpp"
#include "ui/jobs/job_runner.hpp"

namespace pliant::panels {

class BoundaryPanel;
class CellPanel;

/// While a slider of a material moves, and until its boundary is solved anew, the boundary that is predicted for it
/// stands over the solved one.
class BoundaryPredictor final : public QObject {
  Q_OBJECT

 public:
  BoundaryPredictor(document::Document& document, CellPanel& cell, BoundaryPanel& boundary, QObject* parent = nullptr);

  /// Null: there are no derivatives (yet).
  const std::shared_ptr<const scene::BoundaryPrediction>& prediction() const { return prediction_; }

 private:
  void prepare();
  void show();

  document::Document& document_;
  CellPanel& cell_;
  BoundaryPanel& boundary_;
  std::shared_ptr<const scene::StretchBoundaryResult> result_;  ///< that derivatives are of, or asked for
  std::shared_ptr<const scene::BoundaryPrediction> prediction_;
  scene::Json entry_;     ///< of the material on show, normalised
  jobs::JobRunner jobs_;  ///< finds derivatives, which is longer than what others wait for
};

}  // namespace pliant::panels
