#pragma once

#include "ui/render/primitives.hpp"

namespace pliant::render {

/// Draws an actor as if it were nearer to the eye, so that nothing hides it: `share` of its depth, the smaller the more
/// in front.
void seeThrough(vtkActor* actor, double share);

/// Draws an actor as if it were farther from the eye, so that it hides nothing else: `share` of its distance from the
/// far end of the depth.
void seeBehind(vtkActor* actor, double share);

/// Balls of one size at some places.
class Balls {
 public:
  vtkActor* actor() { return markers_.actor(); }
  /// `radius` in [m].
  void show(const std::vector<Eigen::Vector3d>& places, double radius);

 private:
  MarkerPrimitive markers_{MarkerPrimitive::Shape::sphere};
};

/// Dots with a rim that are seen through everything: where two bodies touch, they hide the place between them.
class Marks {
 public:
  /// In device-independent pixels.
  explicit Marks(double diameter);
  std::array<vtkActor*, 2> actors() { return {rims_.actor(), dots_.actor()}; }
  void setColors(const Color& dot, const Color& around);
  void setPixelRatio(double ratio);
  void show(const std::vector<Eigen::Vector3d>& places);

 private:
  DotPrimitive rims_, dots_;
};

}  // namespace pliant::render
