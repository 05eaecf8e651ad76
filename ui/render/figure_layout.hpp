#pragma once

#include <array>
#include <vector>

#include "core/mechanics/model.hpp"
#include "ui/render/points.hpp"

namespace pliant::render {

/// What stays the same while a model moves: what to draw of it and how large.
struct FigureLayout {
  FigureLayout() = default;
  explicit FigureLayout(const mechanics::Model& model);

  /// Measures markers of a model without extent (a single mass, say) by what its motion reaches.
  void setReach(const Points& reach);
  /// Positions of the nodes, after them the ends of springs and of the arms that hold them.
  Points places(const Eigen::VectorXd& positions) const;
  /// Those, and after them the points of the springs' coils.
  Points pose(const Eigen::VectorXd& positions) const;
  /// Radii of `massNodes` for the point masses of `model` [m].
  std::vector<double> massRadii(const mechanics::Model& model) const;

  int dimension = 3;
  Points rest;      ///< of the nodes
  double size = 1;  ///< extent of the model [m]; markers are measured by it
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> outline;              ///< edges of one triangle
  std::vector<std::array<int, 2>> links;                ///< rods and links with their arms: columns of pose()
  std::vector<std::array<int, 2>> springs;              ///< their ends: columns of pose()
  std::vector<std::array<int, 2>> coils;                ///< the pieces of their coils: columns of pose()
  std::vector<mechanics::AttachmentPoint> attachments;  ///< ends of springs and arms
  std::vector<int> massNodes;
  std::vector<int> drivenNodes;
  std::vector<int> fixedPoints;  ///< columns of pose(): locked nodes and fixed ends of springs
  std::vector<int> probeNodes;

 private:
  void addAttached(const std::vector<std::array<mechanics::AttachmentPoint, 2>>& lines,
                   std::vector<std::array<int, 2>>& ends);

  double restExtent_ = 0;
  double referenceMass_ = 1;
};

}  // namespace pliant::render
