#include <cmath>

#include "core/harmonic/design_objective.hpp"
#include "core/scene/target_path.hpp"
#include "ui/panels/compound_row.hpp"
#include "ui/panels/parameter_panel.hpp"
#include "ui/panels/parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

namespace {

jobs::CompoundGoal pathGoal(const scene::TargetPath& target) {
  harmonic::PathGoal path;
  path.paths = {{target.node, harmonic::pathCoefficients(target.places, target.harmonics)}};
  path.matchPlace = target.matchPlace;
  return {ParameterPanel::tr("%1 closer to its target").arg(QString::fromStdString(target.probe)),
          [path](const harmonic::HarmonicBalanceProblem& problem, const harmonic::Vector& z) {
            return harmonic::pathDistance(problem, z, path).rootMeanSquare;
          },
          false};
}

}  // namespace

void ParameterPanel::connectCompound() {
  connect(compound_, &CompoundRow::goalChosen, this, &ParameterPanel::refreshDirection);
  connect(compound_, &CompoundRow::dragged, this, &ParameterPanel::dragAll);
  connect(compound_, &CompoundRow::committed, this, &ParameterPanel::commitAll);
  connect(compound_, &CompoundRow::dragCancelled, this, &ParameterPanel::endAll);
  connect(&session_, &jobs::MotionSession::nodeChanged, this, &ParameterPanel::refreshGoals);
  connect(&session_, &jobs::MotionSession::shownChanged, this, &ParameterPanel::refreshGoals);
  connect(&session_, &jobs::MotionSession::effectsChanged, this, &ParameterPanel::refreshDirection);
  connect(&session_, &jobs::MotionSession::predictionChanged, this, &ParameterPanel::showGoal);
  connect(&document_, &document::Document::sceneEdited, this, [this] {
    endAll();
    refreshGoals();
  });
  connect(&document_, &document::Document::editingChanged, this, [this](bool editing) {
    if (!editing) endAll();
  });
}

void ParameterPanel::refreshGoals() {
  const auto model = document_.model();
  std::vector<jobs::CompoundGoal> goals;
  if (model && model->parameters.size() > 1) {
    goals.push_back(
        jobs::amplitudeGoal(tr("more swing of %1").arg(nodeName(*model, session_.node())), {session_.node()}));
    std::vector<int> nodes;
    for (const mechanics::Probe& probe : model->probes) nodes.push_back(probe.node);
    if (nodes.size() > 1) goals.push_back(jobs::amplitudeGoal(tr("more swing of all probes"), nodes));
    for (const scene::TargetPath& target : scene::targetPaths(document_.scene(), *model))
      goals.push_back(pathGoal(target));
  }
  compound_->setGoals(std::move(goals));
  refreshDirection();
}

void ParameterPanel::refreshDirection() {
  direction_ = {};
  const auto& shown = session_.shown();
  const jobs::CompoundGoal* goal = compound_->goal();
  if (goal && shown && session_.isComparable() && shown->sensitivity && shown->sensitivity->regular()) {
    std::vector<jobs::MovableParameter> movable;
    const auto& parameters = shown->problem->model().parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const ParameterRow* own = row(parameters[i]->pointer());
      if (!own || own->isLocked()) continue;
      const ParameterSlider& slider = *own->slider();
      movable.push_back(
          {own->pointer(), static_cast<int>(i), slider.realValue(), slider.realMinimum(), slider.realMaximum()});
    }
    direction_ = jobs::CompoundDirection(*shown->problem, shown->motion.z, *shown->sensitivity, *goal, movable);
  }
  // The ways begin at the sliders, and trust is known from the motion that was solved.
  if (direction_.isEmpty() || session_.isStale()) {
    trust_.setWays({}, {});
  } else {
    const auto count = static_cast<Eigen::Index>(shown->problem->model().parameters.size());
    trust_.setWays(direction_.way(1, count), direction_.way(-1, count));
  }
  const QString obstacle = session_.predictionObstacle();
  compound_->setMovable(
      !direction_.isEmpty(), obstacle.isEmpty() ? tr("Nothing that is not locked changes it.") : obstacle);
  const auto steps = direction_.steps();
  constexpr double shownShare = 0.25;  // of a whole step, so that arrows fit beside the handles
  for (ParameterRow* each : rows_) {
    const auto step = steps.find(each->pointer());
    each->slider()->setPlannedStep(step == steps.end() ? 0 : shownShare * step->second);
  }
  showGoal();
}

void ParameterPanel::showGoal() {
  const auto& shown = session_.shown();
  const jobs::CompoundGoal* goal = compound_->goal();
  if (!goal || !shown || !shown->solvesDrivenModel) {
    compound_->setPrediction({}, false);
    return;
  }
  const double solved = goal->measure(*shown->problem, shown->motion.z);
  const QString what = goal->wantsMore ? tr("path length %1") : tr("off by %1");
  if (!session_.prediction()) {
    compound_->setPrediction(what.arg(plots::formatLength(solved)), false);
    return;
  }
  const double predicted = goal->measure(*shown->problem, *session_.prediction());
  compound_->setPrediction(
      tr("%1 → predicted %2").arg(plots::formatLength(solved), plots::formatLength(predicted)), true);
}

void ParameterPanel::dragAll(double share) {
  movingAll_ = true;
  const auto values = direction_.valuesAt(share);
  for (ParameterRow* each : rows_)
    if (const auto value = values.find(each->pointer()); value != values.end())
      each->showPreview(value->second);
    else
      each->refresh();
  session_.previewAll(values);
}

void ParameterPanel::commitAll(double share) {
  dragAll(share);
  document::Json json = document_.scene().json();
  const auto values = direction_.valuesAt(share);
  for (const ParameterRow* each : rows_)
    if (const auto value = values.find(each->pointer()); value != values.end()) each->writeTo(json, value->second);
  const jobs::CompoundGoal* goal = compound_->goal();
  const QString text = share > 0 ? tr("All parameters: %1") : tr("All parameters against: %1");
  document_.setValue("", json, text.arg(goal ? goal->name : QString()));
  compound_->rest();
  if (!document_.isEditing()) endAll();
}

void ParameterPanel::endAll() {
  if (!std::exchange(movingAll_, false)) return;
  compound_->rest();
  for (ParameterRow* each : rows_) each->refresh();
  session_.endPreview();
}

}  // namespace pliant::panels
