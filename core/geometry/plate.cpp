#include "core/geometry/plate.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/simplex_distance.hpp"
#include "core/geometry/thick_surface.hpp"

namespace pliant::geometry {

namespace {

using Eigen::Vector2d;
using std::numbers::pi;

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Exact>;
using PolygonWithHoles = CGAL::Polygon_with_holes_2<Exact>;
using Region = CGAL::Polygon_set_2<Exact>;

using Plain = CGAL::Exact_predicates_inexact_constructions_kernel;
using CountedFace =
    CGAL::Constrained_triangulation_face_base_2<Plain, CGAL::Triangulation_face_base_with_info_2<int, Plain>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Plain, CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Plain>, CountedFace>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

using Ring = std::vector<Vector2d>;

/// Corners of a rim that are nearer to each other are one: files with seven digits could not tell them apart [m].
constexpr double shortestSide = 1e-6;

/// So many chords make a whole circle that its arcs are within the tolerance of them; a multiple of 4.
int chordsOfCircle(double radius, double tolerance) {
  const double angle = 2 * std::acos(1 - std::min(tolerance / radius, 0.25));
  return 4 * std::max(2, static_cast<int>(std::ceil(0.5 * pi / angle)));
}

Ring circle(const Vector2d& centre, double radius, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i)
    ring.push_back(centre + radius * Vector2d(std::cos(2 * pi * i / corners), std::sin(2 * pi * i / corners)));
  return ring;
}

/// Counter-clockwise.
Ring convexHull(const Ring& points) {
  std::vector<Plain::Point_2> all, hull;
  for (const Vector2d& point : points) all.emplace_back(point[0], point[1]);
  CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(hull));
  Ring ring;
  for (const auto& point : hull) ring.emplace_back(point.x(), point.y());
  return ring;
}

/// All that is within `radius` of the convex hull of the points: the hull of circles around them and of where its
/// straight sides begin and end.
Ring roundedHull(const Ring& points, double radius, double tolerance) {
  const int corners = chordsOfCircle(radius, tolerance);
  Ring all;
  for (const Vector2d& point : points)
    for (const Vector2d& place : circle(point, radius, corners)) all.push_back(place);
  const Ring hull = convexHull(points);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d &from = hull[i], &to = hull[(i + 1) % hull.size()];
    if (hull.size() == 1) break;
    const Vector2d outwards = radius * Vector2d(to[1] - from[1], from[0] - to[0]).normalized();
    all.push_back(from + outwards);
    all.push_back(to + outwards);
  }
  return convexHull(all);
}

Polygon polygonOf(const Ring& ring) {
  Polygon polygon;
  for (const Vector2d& point : ring) polygon.push_back({point[0], point[1]});
  return polygon;
}

Ring ringOf(const Polygon& polygon) {
  Ring ring;
  for (const auto& point : polygon.container()) {
    const Vector2d place(CGAL::to_double(point.x()), CGAL::to_double(point.y()));
    if (ring.empty() || (place - ring.back()).norm() > shortestSide) ring.push_back(place);
  }
  while (ring.size() > 1 && (ring.front() - ring.back()).norm() <= shortestSide) ring.pop_back();
  return ring;
}

/// The one piece that a region consists of.
PolygonWithHoles onlyPiece(const Region& region, const char* otherwise) {
  std::vector<PolygonWithHoles> pieces;
  region.polygons_with_holes(std::back_inserter(pieces));
  if (pieces.size() != 1) throw base::InputError("", otherwise);
  return pieces.front();
}

void checkOutline(const PlateOutline& outline, double thickness, double tolerance) {
  if (!(outline.width > 0 && thickness > 0 && tolerance > 0))
    throw base::InputError("", "a plate's width, thickness and tolerance must be above 0");
  for (std::size_t i = 0; i < outline.holes.size(); ++i) {
    const RoundHole& hole = outline.holes[i];
    if (!(hole.diameter > 0)) throw base::InputError("", "the diameter of a hole must be above 0");
    for (std::size_t j = 0; j < i; ++j)
      if ((outline.holes[j].centre - hole.centre).norm() <= 0.5 * (outline.holes[j].diameter + hole.diameter))
        throw base::InputError("", "two of its holes run into each other");
  }
}

/// Numbers the parts that rims divide the plane into by how many rims lie between them and what is outside of all.
void countRims(Triangulation& triangulation) {
  for (const auto face : triangulation.all_face_handles()) face->info() = -1;
  std::vector<Triangulation::Face_handle> now{triangulation.infinite_face()}, next;
  for (int rims = 0; !now.empty(); ++rims, now.swap(next), next.clear())
    while (!now.empty()) {
      const Triangulation::Face_handle face = now.back();
      now.pop_back();
      if (face->info() >= 0) continue;
      face->info() = rims;
      for (int i = 0; i < 3; ++i) (face->is_constrained(i) ? next : now).push_back(face->neighbor(i));
    }
}

/// The triangles between the rims of a plane region, at z = 0.
SurfaceMesh trianglesWithin(const PolygonWithHoles& region) {
  Triangulation triangulation;
  const auto insert = [&](const Polygon& polygon) {
    std::vector<Plain::Point_2> points;
    for (const Vector2d& point : ringOf(polygon)) points.emplace_back(point[0], point[1]);
    if (points.size() > 2) triangulation.insert_constraint(points.begin(), points.end(), true);
  };
  try {
    insert(region.outer_boundary());
    for (const Polygon& hole : region.holes()) insert(hole);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw base::InputError("", "its rim touches itself or a hole");
  }
  countRims(triangulation);
  std::map<Triangulation::Vertex_handle, int> index;
  SurfaceMesh mesh;
  mesh.points.setZero(3, static_cast<Eigen::Index>(triangulation.number_of_vertices()));
  for (const auto vertex : triangulation.finite_vertex_handles()) {
    const int i = static_cast<int>(index.size());
    mesh.points.col(i).head<2>() << vertex->point().x(), vertex->point().y();
    index[vertex] = i;
  }
  for (const auto face : triangulation.finite_face_handles())
    if (face->info() % 2 == 1)
      mesh.triangles.push_back({index[face->vertex(0)], index[face->vertex(1)], index[face->vertex(2)]});
  return mesh;
}

}  // namespace

SurfaceMesh makePlate(const PlateOutline& outline, double thickness, double tolerance) {
  checkOutline(outline, thickness, tolerance);
  Region region;
  for (const auto& points : outline.hulls) region.join(polygonOf(roundedHull(points, 0.5 * outline.width, tolerance)));
  const std::size_t openings = onlyPiece(region, "its outline is in several pieces").number_of_holes();
  for (const RoundHole& hole : outline.holes) {
    const int corners = chordsOfCircle(0.5 * hole.diameter, tolerance);
    region.difference(polygonOf(circle(hole.centre, 0.5 * hole.diameter / std::cos(pi / corners), corners)));
  }
  const PolygonWithHoles plate = onlyPiece(region, "its holes cut it into pieces");
  if (plate.number_of_holes() != openings + outline.holes.size())
    throw base::InputError("", "one of its holes reaches its rim");
  const SurfaceMesh flat = trianglesWithin(plate);
  SurfaceMesh solid = thickenSurface(flat, std::vector<double>(flat.triangles.size(), thickness));
  solid.points.row(2).array() += 0.5 * thickness;
  return solid;
}

double distanceBetween(const PlateOutline& a, const PlateOutline& b) {
  double least = std::numeric_limits<double>::infinity();
  const auto compare = [&](SimplexPair pair, std::initializer_list<Vector2d> places) {
    Corners corners = Corners::Zero();
    Eigen::Index count = 0;
    for (const Vector2d& place : places) corners.col(count++).head<2>() = place;
    least = std::min(least, std::sqrt(closestPoints(pair, corners).squaredDistance));
  };
  // A convex hull is all triangles between its points, and the boundaries of these are all edges.
  const auto pointsAndTriangles = [&](const Ring& points, const Ring& corners) {
    for (const Vector2d& point : points)
      for (std::size_t i = 2; i < corners.size(); ++i)
        for (std::size_t j = 1; j < i; ++j)
          for (std::size_t k = 0; k < j; ++k)
            compare(SimplexPair::pointTriangle, {point, corners[i], corners[j], corners[k]});
  };
  const auto edgesOf = [](const Ring& points) {
    std::vector<std::array<Vector2d, 2>> edges;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) edges.push_back({points[i], points[j]});
    return edges;
  };
  for (const Ring& first : a.hulls)
    for (const Ring& second : b.hulls) {
      for (const auto& [p, q] : edgesOf(first))
        for (const auto& [r, s] : edgesOf(second)) compare(SimplexPair::edgeEdge, {p, q, r, s});
      pointsAndTriangles(first, second);
      pointsAndTriangles(second, first);
    }
  return std::max(0.0, least - 0.5 * (a.width + b.width));
}

}  // namespace pliant::geometry
