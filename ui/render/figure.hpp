#pragma once

#include <vtkRenderer.h>

#include <memory>

#include "core/mechanics/model.hpp"
#include "ui/render/primitives.hpp"

namespace pliant::render {

/// What stays the same while a model moves: what to draw of it and how large.
struct FigureLayout {
  FigureLayout() = default;
  explicit FigureLayout(const mechanics::Model& model);

  /// Measures markers of a model without extent (a single mass, say) by what its motion reaches.
  void setReach(const Points& reach);
  /// Positions of the nodes, after them the fixed ends of grounded springs, and the ends of springs on links.
  Points pose(const Eigen::VectorXd& positions) const;
  /// Radii of `massNodes` for the point masses of `model` [m].
  std::vector<double> massRadii(const mechanics::Model& model) const;

  int dimension = 3;
  Points rest;      ///< of the nodes
  double size = 1;  ///< extent of the model [m]; markers are measured by it
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> outline;              ///< edges of one triangle
  std::vector<std::array<int, 2>> springs;              ///< columns of pose()
  Points anchors{3, 0};                                 ///< fixed ends of springs
  std::vector<mechanics::AttachmentPoint> attachments;  ///< ends of springs that move with links
  std::vector<int> massNodes;
  std::vector<int> drivenNodes;
  std::vector<int> fixedPoints;  ///< columns of pose(): locked nodes and fixed ends of springs
  std::vector<int> probeNodes;

 private:
  double restExtent_ = 0;
  double referenceMass_ = 1;
};

/// Surface, springs, masses and supports in one configuration: the solved one in full, or a predicted one as a ghost.
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
  LinePrimitive springs_;
  MarkerPrimitive masses_{MarkerPrimitive::Shape::sphere};
  MarkerPrimitive driven_{MarkerPrimitive::Shape::cube};
  MarkerPrimitive fixed_{MarkerPrimitive::Shape::cube};
};

}  // namespace pliant::render
