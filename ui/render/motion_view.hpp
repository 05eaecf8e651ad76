#pragma once

#include <memory>
#include <optional>

#include "core/harmonic/harmonic_balance_problem.hpp"
#include "ui/render/view.hpp"

namespace pliant::render {

/// What is seen of one model: its surface coloured by stretch, springs, masses, driven nodes, trajectories, and over it
/// the predicted motion as a hatched ghost. It only draws; motions come from outside. Models of one or two dimensions
/// lie in the plane z = 0.
class MotionView final : public View {
 public:
  MotionView();
  ~MotionView() override;

  /// Shows a model at rest; motion, prediction and selection are cleared. Null: an empty view.
  void setModel(std::shared_ptr<const mechanics::Model> model);
  /// The solved motion, coefficients `z` of `problem`, whose model has the nodes of the model shown.
  void setMotion(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, mechanics::Vector z);
  void clearMotion();
  /// The predicted motion, coefficients of the problem given to setMotion (ignored if there is none). `changedModel`,
  /// if given, tells the predicted point masses and where driven and locked nodes are (see PredictedMotion).
  void setPrediction(const mechanics::Vector& z, std::shared_ptr<const mechanics::Model> changedModel = nullptr);
  void clearPrediction();
  /// Greys the solved motion: inputs have changed since.
  void setStale(bool stale);
  /// The place in the period, in radians.
  void setTau(double tau);
  double tau() const;

  /// Its trajectory is drawn, like those of the model's probes.
  void setSelectedNode(std::optional<int> node);
  std::optional<int> selectedNode() const;
  std::optional<int> pickNode(double x, double y, double radius) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
