#include "ui/panels/boundary_predictor.hpp"

#include <QPointer>

#include "ui/panels/boundary_panel.hpp"
#include "ui/panels/cell_panel.hpp"

namespace pliant::panels {

BoundaryPredictor::BoundaryPredictor(document::Document& document, CellPanel& cell, BoundaryPanel& boundary,
                                     QObject* parent)
    : QObject(parent), document_(document), cell_(cell), boundary_(boundary) {
  connect(&document_, &document::Document::studyChanged, this, [this](const std::string& name) {
    if (name == boundary_.study()) prepare();
  });
  connect(&boundary_, &BoundaryPanel::resultShown, this, &BoundaryPredictor::prepare);
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    result_.reset();
    prediction_.reset();
    entry_ = {};
    show();
  });
  connect(&cell_, &CellPanel::cellInspected, this, [this](const jobs::InspectedCell& cell, bool) {
    entry_ = cell.normalized;
    show();
  });
}

void BoundaryPredictor::prepare() {
  const document::StudyState* study = document_.study(boundary_.study());
  const auto result = study ? std::dynamic_pointer_cast<const scene::StretchBoundaryResult>(study->result) : nullptr;
  if (result == result_) return show();
  // Derivatives are of the scene that the result was computed from; without it there are none.
  const bool known = result && study->solvedScene && result->termination == base::TerminationType::converged;
  result_ = known ? result : nullptr;
  prediction_.reset();
  show();
  if (!known) return;
  jobs::Job job;
  job.topic = QStringLiteral("boundary prediction");
  job.work = [link = QPointer<BoundaryPredictor>(this), scene = *study->solvedScene, result](
                 base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
    auto prediction = std::make_shared<const scene::BoundaryPrediction>(scene, result, context);
    if (context.cancelRequested()) return {};
    return [link, result, prediction] {
      if (!link || link->result_ != result) return;
      link->prediction_ = prediction;
      link->show();
    };
  };
  jobs_.submit(std::move(job));
}

void BoundaryPredictor::show() {
  const bool applies =
      prediction_ && entry_.is_object() && cell_.shownCell() == static_cast<int>(prediction_->cellIndex());
  const auto predicted = applies ? prediction_->predict(entry_) : nullptr;
  if (!predicted) return boundary_.showPredicted(nullptr);
  boundary_.showPredicted(
      std::make_shared<scene::BoundarySurface>(scene::boundarySurface(*predicted, tr("predicted").toStdString())));
}

}  // namespace pliant::panels
