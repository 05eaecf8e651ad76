#pragma once

#include "ui/render/motion_view.hpp"

namespace pliant::render {

/// Two motions of models with the same nodes side by side in one window: one camera, one scale of colours. The left one
/// is a view that has the window to itself before and after.
class MotionPair {
 public:
  /// `left` outlives the pair. Nothing is shown yet.
  explicit MotionPair(MotionView& left);
  /// Gives the window back to the left view.
  ~MotionPair();
  MotionPair(const MotionPair&) = delete;
  MotionPair& operator=(const MotionPair&) = delete;

  MotionView& right() { return right_; }
  const MotionView& right() const { return right_; }
  /// Shows both in `window`, which shows the left one so far.
  void attach(vtkRenderWindow* window);
  void setRight(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const mechanics::Vector& z,
                const std::string& caption);
  /// Takes scale of colours and reach anew: something was set at the left view.
  void share();
  void setTheme(Theme theme);
  void setPixelRatio(double ratio);
  void setFieldVisible(bool visible);
  void setFineQuality(bool fine);
  void setTau(double tau) { right_.setTau(tau); }
  /// The window has another size.
  void layOut();
  /// Where the right half begins, in pixels from the left of the window.
  double rightBegin() const;

 private:
  struct Backdrop;
  MotionView& left_;
  MotionView right_;
  std::unique_ptr<Backdrop> backdrop_;
  vtkRenderWindow* window_ = nullptr;
  Theme theme_ = Theme::light;
  double ratio_ = 1;
};

}  // namespace pliant::render
