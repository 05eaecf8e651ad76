#pragma once

#include <Eigen/Geometry>

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// Closest points of a closed triangle surface, and on which side of it a point lies. Any thread may ask.
class SurfaceDistance {
 public:
  /// Triangles counterclockwise from outside. Throws base::InputError (location empty) as checkClosed does.
  explicit SurfaceDistance(SurfaceMesh mesh);

  enum class Feature { face, edge, vertex };
  struct Closest {
    double distance = 0;  ///< above 0 outside, below 0 inside
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Feature feature = Feature::face;
    int triangle = -1;  ///< one of those that the feature belongs to
    /// Of the signed distance: a unit vector, on the surface itself the (pseudo)normal there.
    Eigen::Vector3d gradient = Eigen::Vector3d::UnitZ();
    /// Of the signed distance while the feature stays the same: 0 by a face, (I - nnᵀ - eeᵀ)/d by an edge e,
    /// (I - nnᵀ)/d by a vertex; 0 at d = 0.
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  };
  /// The side is that of the closest feature's normal, an edge's being the sum of those of its faces and a vertex's
  /// that of its faces weighted by their angles, which is right everywhere (Bærentzen & Aanæs 2005).
  Closest closest(const Eigen::Vector3d& p) const;

  const SurfaceMesh& mesh() const { return mesh_; }
  const Eigen::AlignedBox3d& box() const { return nodes_.front().box; }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0, count = 0;  ///< of a leaf's triangles in order_; count 0: not a leaf
    int left = -1, right = -1;
  };
  int buildNode(int first, int count);

  SurfaceMesh mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  Eigen::Matrix3Xd faceNormals_, vertexNormals_;
  std::vector<std::array<Eigen::Vector3d, 3>> edgeNormals_;  ///< of corner i to i + 1; not normalised
};

}  // namespace pliant::geometry
