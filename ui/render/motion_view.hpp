#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/harmonic/harmonic_balance_problem.hpp"
#include "ui/render/points.hpp"
#include "ui/render/target_curve.hpp"
#include "ui/render/view.hpp"

class vtkLookupTable;
class vtkRenderer;

namespace pliant::render {

class CameraControl;

/// What the colours of a field span.
struct FieldRange {
  double least = 0, most = 0;
};

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
  /// A motion of another model with the same nodes as the ghost, drawn in that model's shape and named by `label`
  /// (ignored if no motion is on show).
  void setGhost(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const mechanics::Vector& z,
                const std::string& label);
  bool showsGhost() const;
  /// Takes either ghost away.
  void clearPrediction();
  /// Greys the solved motion: inputs have changed since.
  void setStale(bool stale);
  /// The place in the period, in radians.
  void setTau(double tau);
  double tau() const;
  /// Periods that τ goes through from 0 to 2π: more than 1 of a motion with two driving frequencies.
  int periods() const;

  /// Its trajectory is drawn, like those of the model's probes.
  void setSelectedNode(std::optional<int> node);
  std::optional<int> selectedNode() const;
  std::optional<int> pickNode(double x, double y, double radius) const override;

  /// Closed paths that nodes are to run along; beside the motion.
  void setTargets(std::vector<TargetCurve> targets);
  const std::vector<TargetCurve>& targets() const;

  bool showsField() const;
  /// The stretches less 1 that the motion on show reaches; 0 and next to it without a field.
  FieldRange fieldRange() const;
  /// Colours by this range, with the scalar bar elsewhere; none: by its own.
  void setSharedRange(std::optional<FieldRange> range);
  vtkLookupTable* colorTable() const;
  /// Where anything on show comes.
  Points reach() const;
  /// What else is brought into view and not clipped.
  void setBeyond(Points beyond);
  void setGizmoVisible(bool visible);
  vtkRenderer* renderer() const;
  const CameraControl& camera() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
