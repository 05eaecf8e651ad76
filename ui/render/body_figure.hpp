#pragma once

#include <vtkRenderer.h>

#include <memory>
#include <vector>

#include "core/cloth/cloth_problem.hpp"
#include "ui/render/sheet_primitive.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

/// The bodies that a cloth lies on: surfaces, capsules and spheres, with their radius.
class BodyFigure {
 public:
  void addTo(vtkRenderer* renderer) { renderer_ = renderer; }
  void setBodies(const std::vector<cloth::Body>& bodies);
  /// Of the points of all bodies, one body after the other.
  void setPoints(const Points& points);
  void setColor(const Color& color);

 private:
  /// Surface points of one body follow from its points: the triangles' own, or spheres and cylinders around them.
  struct Part {
    SheetPrimitive surface;
    std::vector<int> points;                ///< columns of setPoints()
    std::vector<std::array<int, 2>> edges;  ///< of a capsule, in `points`
    bool swept = false;                     ///< spheres and cylinders rather than triangles
    double radius = 0;
  };
  void setSwept(Part& part, const Points& points);

  vtkRenderer* renderer_ = nullptr;
  std::vector<std::unique_ptr<Part>> parts_;
  Color color_{};
};

}  // namespace pliant::render
