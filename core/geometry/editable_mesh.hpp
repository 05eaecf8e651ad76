#pragma once

#include <set>

#include "core/geometry/implicit_surface.hpp"

namespace pliant::geometry {

/// A closed triangle mesh that is being fitted to the surface of a body. All changes keep it a closed manifold.
class EditableMesh {
 public:
  /// Points of no triangle are left out.
  explicit EditableMesh(const SurfaceMesh& mesh);

  /// Edges shorter than `length` [m] become a point, unless a triangle would turn over and it is not to be done
  /// `always`.
  void collapseShortEdges(const BodyDistance& body, double length, bool always = false);
  /// Edges become the other diagonal of their two triangles where that makes opposite angles smaller.
  void flipEdges();
  /// Each point goes to the middle of its neighbours, and back to the surface.
  void relax(const BodyDistance& body);
  /// Halves edges until the middles of edges and triangles are within `tolerance` [m] of the surface, as far as edges
  /// longer than twice that can do it: others are near enough, since their ends are. An edge that spans an opening
  /// which the mesh does not have stays as it is.
  SurfaceFit splitToTolerance(const BodyDistance& body, double tolerance);

  SurfaceMesh finish() const;

 private:
  using Edge = std::array<int, 2>;
  std::vector<Edge> edges() const;  ///< (a < b), sorted
  /// The two triangles of an edge: the first runs from a to b.
  std::array<int, 2> trianglesAt(const Edge& edge) const;
  int oppositeCorner(int triangle, const Edge& edge) const;
  std::vector<int> neighboursOf(int point) const;
  Eigen::Vector3d normalOf(const std::array<int, 3>& corners) const;
  /// Whether the triangles around a point keep their sense if it is moved; those with the corner `except` do not count.
  bool staysUpright(int point, const Eigen::Vector3d& to, int except = -1) const;
  void collapse(const Edge& edge, const Eigen::Vector3d& to);
  void split(const Edge& edge, const Eigen::Vector3d& at);
  void replaceCorner(int triangle, int from, int to);
  void forget(int point, int triangle);

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<int, 3>> triangles_;  ///< removed ones have corner -1
  std::vector<std::vector<int>> around_;       ///< triangles of each point
  std::set<Edge> stuck_;                       ///< edges that span an opening
};

}  // namespace pliant::geometry
