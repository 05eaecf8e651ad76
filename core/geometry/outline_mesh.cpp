#include "core/geometry/outline_mesh.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <map>

#include "core/base/error.hpp"

namespace pliant::geometry {

namespace {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Structure = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>,
                                                       CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

constexpr double mostTriangles = 1e6;
/// Of a triangle's smallest angle: sin² of it, with which refinement is sure to end.
constexpr double shape = 0.125;

void checkPolygons(const std::vector<Matrix2Xd>& polygons, double size) {
  if (polygons.empty()) throw base::InputError("", "an outline needs a polygon");
  if (!(size > 0) || !std::isfinite(size)) throw base::InputError("", "the size of triangles must be above 0");
  for (const Matrix2Xd& polygon : polygons) {
    if (polygon.cols() < 3) throw base::InputError("", "an outline needs at least three corners");
    if (!polygon.allFinite()) throw base::InputError("", "a corner of the outline is not finite");
    if (polygonArea(polygon) == 0) throw base::InputError("", "the outline has no area");
  }
  if (std::abs(polygonArea(polygons.front())) / (0.4 * size * size) > mostTriangles)
    throw base::InputError("", "the outline would have more than a million triangles");
}

bool isInPiece(const std::vector<Matrix2Xd>& polygons, const Vector2d& place) {
  bool inside = isInPolygon(polygons.front(), place);
  for (std::size_t i = 1; i < polygons.size(); ++i) inside = inside && !isInPolygon(polygons[i], place);
  return inside;
}

}  // namespace

bool isInPolygon(const Matrix2Xd& polygon, const Vector2d& place) {
  bool inside = false;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Vector2d from = polygon.col(i), to = polygon.col((i + 1) % polygon.cols());
    if ((from[1] > place[1]) == (to[1] > place[1])) continue;
    if (from[0] + (place[1] - from[1]) / (to[1] - from[1]) * (to[0] - from[0]) > place[0]) inside = !inside;
  }
  return inside;
}

double polygonArea(const Matrix2Xd& polygon) {
  double area = 0;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Vector2d from = polygon.col(i), to = polygon.col((i + 1) % polygon.cols());
    area += 0.5 * (from[0] * to[1] - from[1] * to[0]);
  }
  return area;
}

SurfaceMesh meshOutline(const std::vector<Matrix2Xd>& polygons, double size) {
  checkPolygons(polygons, size);
  Delaunay triangulation;
  try {
    for (const Matrix2Xd& polygon : polygons)
      for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
        const Vector2d from = polygon.col(i), to = polygon.col((i + 1) % polygon.cols());
        if (from == to) continue;
        triangulation.insert_constraint({from[0], from[1]}, {to[0], to[1]});
      }
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    throw base::InputError("", "the outline crosses itself");
  }
  // One place inside marks the piece, and the triangles there must make up all of its area.
  double area = 0, largest = 0;
  std::vector<Kernel::Point_2> inside;
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    Eigen::Matrix<double, 2, 3> corners;
    for (int i = 0; i < 3; ++i) corners.col(i) << face->vertex(i)->point().x(), face->vertex(i)->point().y();
    const Vector2d middle = corners.rowwise().mean();
    if (!isInPiece(polygons, middle)) continue;
    const double own = polygonArea(corners);
    area += own;
    if (own <= largest) continue;
    largest = own;
    inside.assign(1, {middle[0], middle[1]});
  }
  double wanted = std::abs(polygonArea(polygons.front()));
  for (std::size_t i = 1; i < polygons.size(); ++i) wanted -= std::abs(polygonArea(polygons[i]));
  constexpr double rounding = 1e-9;
  if (inside.empty() || std::abs(area - wanted) > rounding * std::abs(polygonArea(polygons.front())))
    throw base::InputError("", "a hole of the outline is not inside it, or the outline crosses itself");
  CGAL::Delaunay_mesher_2<Delaunay, CGAL::Delaunay_mesh_size_criteria_2<Delaunay>> mesher(
      triangulation, CGAL::Delaunay_mesh_size_criteria_2<Delaunay>(shape, size));
  mesher.set_seeds(inside.begin(), inside.end(), true);
  mesher.refine_mesh();

  SurfaceMesh mesh;
  std::map<Delaunay::Vertex_handle, int> numbers;
  std::vector<Vector2d> points;
  double found = 0;
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    if (!face->is_in_domain()) continue;
    auto& triangle = mesh.triangles.emplace_back();
    Eigen::Matrix<double, 2, 3> corners;
    for (int i = 0; i < 3; ++i) {
      const auto [place, isNew] = numbers.emplace(face->vertex(i), static_cast<int>(points.size()));
      corners.col(i) << face->vertex(i)->point().x(), face->vertex(i)->point().y();
      if (isNew) points.push_back(corners.col(i));
      triangle[static_cast<std::size_t>(i)] = place->second;
    }
    found += polygonArea(corners);
  }
  if (std::abs(found - wanted) > rounding * std::abs(polygonArea(polygons.front())))
    throw base::InputError("", "the outline is not one piece");
  mesh.points.setZero(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) mesh.points.col(static_cast<Eigen::Index>(i)).head<2>() = points[i];
  return mesh;
}

}  // namespace pliant::geometry
