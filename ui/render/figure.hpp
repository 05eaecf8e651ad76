#pragma once

#include <vtkRenderer.h>

#include "ui/render/figure_layout.hpp"
#include "ui/render/primitives.hpp"

namespace pliant::render {

/// Surface, links, springs, masses and supports in one configuration: the solved one in full, or a predicted one as a
/// ghost.
class Figure {
 public:
  enum class Kind { solved, ghost };
  explicit Figure(Kind kind);

  void addTo(vtkRenderer* renderer);
  void setLayout(const FigureLayout& layout);
  void setMassRadii(const FigureLayout& layout, const std::vector<double>& radii);
  void setPose(const Points& pose);
  void setField(const Eigen::VectorXd* field, vtkLookupTable* table) { surface_.setField(field, table); }
  void setVisible(bool visible);
  void setTheme(const Palette& palette, bool stale);
  void setPixelRatio(double ratio);

 private:
  std::vector<vtkActor*> actors();

  Kind kind_;
  vtkNew<vtkPoints> points_;
  SurfacePrimitive surface_;
  LinePrimitive outline_;
  LinePrimitive links_;
  LinePrimitive coils_;
  MarkerPrimitive masses_{MarkerPrimitive::Shape::sphere};
  MarkerPrimitive driven_{MarkerPrimitive::Shape::cube};
  MarkerPrimitive fixed_{MarkerPrimitive::Shape::cube};
};

}  // namespace pliant::render
