#pragma once

#include <optional>
#include <vector>

#include "core/geometry/surface_mesh.hpp"

namespace pliant::interlock {

/// The smooth shape of a deformed sheet of triangles. Between nodes it is the mean of the linear interpolation of
/// places and of the places to which the nodes' own linear maps lead, which is exact where the deformation is quadratic
/// (James 2020, "Phong deformation"); the map of a node is the mean of those of its triangles, weighted by area.
class SheetShape {
 public:
  /// Flat, in z = 0.
  explicit SheetShape(geometry::SurfaceMesh mesh);

  /// A point of the sheet at rest.
  struct Place {
    int triangle = -1;
    Eigen::Vector3d shares = Eigen::Vector3d::Zero();  ///< of the triangle's corners
  };
  /// Nothing if the point is not in the sheet (its rim belongs to it).
  std::optional<Place> placeOf(const Eigen::Vector2d& point) const;

  /// Of the nodes, for `positions` (3 x nodes) [m].
  using Map = Eigen::Matrix<double, 3, 2>;
  std::vector<Map> nodeMaps(const Eigen::Matrix3Xd& positions) const;

  /// Where a point is, and how the sheet is turned there: the rotation of the polar decomposition of the map in the
  /// plane, and the normal.
  struct Frame {
    Eigen::Vector3d position;
    Eigen::Matrix3d rotation;
  };
  Frame frameAt(const Place& place, const Eigen::Matrix3Xd& positions, const std::vector<Map>& maps) const;

  const geometry::SurfaceMesh& mesh() const { return mesh_; }

 private:
  std::size_t binOf(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  geometry::SurfaceMesh mesh_;
  std::vector<Eigen::Matrix2d> inverses_;  ///< of each triangle's edges at rest [1/m]
  std::vector<double> areas_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  double bin_ = 1;  ///< [m]
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> bins_;  ///< triangles by place
};

}  // namespace pliant::interlock
