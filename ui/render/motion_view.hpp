#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/harmonic/harmonic_balance_problem.hpp"
#include "ui/render/theme.hpp"

class vtkRenderWindow;

namespace pliant::render {

/// Where the camera looks from.
enum class AxisView { front, back, right, left, top, bottom, isometric };

/// What is seen of one model: its surface coloured by stretch, springs, masses, driven nodes, trajectories, and over it
/// the predicted motion as a hatched ghost. It only draws; motions come from outside. Models of one or two dimensions
/// lie in the plane z = 0. Belongs to the thread that owns its window.
class MotionView {
 public:
  MotionView();
  ~MotionView();
  MotionView(const MotionView&) = delete;
  MotionView& operator=(const MotionView&) = delete;

  /// Shows itself in `window` from now on (null: in none). The window must outlive that.
  void attach(vtkRenderWindow* window);

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
  /// The small label in the top left corner; lines separated by '\n'; empty: none.
  void setCaption(const std::string& text);
  void setTheme(Theme theme);
  /// Colours by stretch, with the scalar bar (on at first).
  void setFieldVisible(bool visible);
  /// Pixels per device-independent pixel: scales text, lines and markers.
  void setPixelRatio(double ratio);
  /// Smooth edges (8 samples a pixel): cheap on a graphics processor, but six times the cost of a frame in software,
  /// where it is for stills. On at first.
  void setFineQuality(bool fine);

  /// Looks at everything the motion reaches.
  void fit();
  void setAxisView(AxisView view);
  /// Turns about the middle of the view; fractions of the window's height (a whole height: 180°), x to the right, y
  /// down.
  void orbit(double dx, double dy);
  /// Moves the scene with the pointer; physical pixels.
  void pan(double dx, double dy);
  /// Enlarges by `factor`, keeping what is under the pixel (x, y) (from the top left) in place.
  void zoom(double factor, double x, double y);
  /// The node nearest to the pixel (x, y) (from the top left) within `radius` pixels, as drawn at present.
  std::optional<int> pickNode(double x, double y, double radius) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
