#include "core/mechanics/strain_limits.hpp"

#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/mechanics/strain_limit_element.hpp"

namespace pliant::mechanics {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Where six places lie nearly on a conic their quadratic would magnify angles by more than this times what four
/// regular triangles do.
constexpr double largestAmplification = 8;

Vector3d strainVector(const Matrix2d& tensor) {
  return {0.5 * (tensor(0, 0) + tensor(1, 1)), 0.5 * (tensor(0, 0) - tensor(1, 1)), tensor(0, 1)};
}

/// Rest edges from corner 0, in columns.
Matrix2d restEdges(const LimitedTriangle& triangle, std::size_t index) {
  Matrix2d edges;
  edges << triangle.rest.col(1) - triangle.rest.col(0), triangle.rest.col(2) - triangle.rest.col(0);
  if (!(edges.determinant() > geometry::smallestRelativeArea * edges.squaredNorm()))
    throw base::InputError("", "Triangle " + std::to_string(index) + " has no area at rest, or is turned over.");
  return edges;
}

StretchLimitElement stretchElement(const LimitedTriangle& triangle, std::size_t index) {
  const Matrix2d edges = restEdges(triangle, index), inverse = edges.inverse();
  StretchLimitElement element;
  element.set = triangle.stretch;
  element.area = 0.5 * edges.determinant();
  element.restEdges = edges;
  element.restMetric = {edges.col(0).squaredNorm(), edges.col(1).squaredNorm(), edges.col(0).dot(edges.col(1))};
  for (int k = 0; k < 3; ++k) {
    Matrix2d metric = Matrix2d::Zero();
    if (k < 2)
      metric(k, k) = 1;
    else
      metric(0, 1) = metric(1, 0) = 1;
    element.strainOfMetric.col(k) = strainVector(0.5 * inverse.transpose() * metric * inverse);
  }
  return element;
}

/// A triangle with its neighbours, flat at rest, in the material's axes of that triangle.
struct TriangleStencil {
  std::array<int, 6> nodes;  ///< a neighbour's that is not there is the corner opposite it
  Eigen::Matrix<double, 2, 6> rest;

  bool hasNeighbour(int i) const { return nodes[3 + i] != nodes[i]; }
};

std::vector<TriangleStencil> triangleStencils(const std::vector<LimitedTriangle>& triangles) {
  std::vector<std::array<int, 3>> corners;
  std::vector<TriangleStencil> result;
  for (const LimitedTriangle& triangle : triangles) {
    const auto& [a, b, c] = corners.emplace_back(triangle.nodes);
    TriangleStencil& stencil = result.emplace_back();
    stencil.nodes = {a, b, c, a, b, c};
    stencil.rest << triangle.rest, triangle.rest;
  }
  const auto opposite = [&](int triangle, const std::array<int, 2>& edge) {
    int corner = 0;
    while (corners[triangle][corner] == edge[0] || corners[triangle][corner] == edge[1]) ++corner;
    return corner;
  };
  // Beside edge i of triangle s stands corner j of triangle t, unfolded into the plane of s.
  const auto join = [&](int s, int i, int t, int j) {
    result[s].nodes[3 + i] = corners[t][j];
    const auto side = [&triangles](int triangle, int corner) -> std::array<Vector2d, 2> {
      const auto& rest = triangles[triangle].rest;
      const Vector2d from = rest.col((corner + 1) % 3);
      return {from, (rest.col((corner + 2) % 3) - from).normalized()};
    };
    const auto [end, theirs] = side(t, j);  // which runs the other way
    const auto [from, ours] = side(s, i);
    const Vector2d offset = triangles[t].rest.col(j) - end;
    const double length = (triangles[s].rest.col((i + 2) % 3) - from).norm();
    const double along = length - offset.dot(theirs), height = theirs.x() * offset.y() - theirs.y() * offset.x();
    result[s].rest.col(3 + i) = from + along * ours + height * Vector2d(ours.y(), -ours.x());
  };
  for (const geometry::MeshEdge& edge : geometry::meshEdges(corners)) {
    const auto [s, t] = edge.triangles;
    if (s < 0 || t < 0) continue;
    const int i = opposite(s, edge.nodes), j = opposite(t, edge.nodes);
    join(s, i, t, j);
    join(t, j, s, i);
  }
  return result;
}

/// Slope of the plane through heights over three places.
Vector2d slopeOf(const Eigen::Matrix<double, 2, 3>& places, const Vector3d& heights) {
  Matrix2d edges;
  edges << places.col(1) - places.col(0), places.col(2) - places.col(0);
  return edges.transpose().inverse() * Vector2d(heights[1] - heights[0], heights[2] - heights[0]);
}

/// What the angles of a triangle's hinges are, to first order, on z = ½ xᵀ s x: a column for each of mean, deviator and
/// shear [m].
Matrix3d anglesOfCurvature(const TriangleStencil& stencil) {
  Matrix3d angles;
  for (int k = 0; k < 3; ++k) {
    const Matrix2d tensor = (Matrix2d() << (k < 2 ? 1 : 0), (k == 2 ? 1 : 0), (k == 2 ? 1 : 0),
                             (k == 0   ? 1
                              : k == 1 ? -1
                                       : 0))
                                .finished();
    const auto height = [&](int corner) -> double {
      return 0.5 * stencil.rest.col(corner).dot(tensor * stencil.rest.col(corner));
    };
    const auto slope = [&](int a, int b, int c) {
      Eigen::Matrix<double, 2, 3> places;
      places << stencil.rest.col(a), stencil.rest.col(b), stencil.rest.col(c);
      return slopeOf(places, {height(a), height(b), height(c)});
    };
    const Vector2d own = slope(0, 1, 2);
    for (int i = 0; i < 3; ++i) {
      const int a = (i + 1) % 3, b = (i + 2) % 3;
      const Vector2d edge = (stencil.rest.col(b) - stencil.rest.col(a)).normalized();
      angles(i, k) = -(slope(a, b, 3 + i) - own).dot(Vector2d(edge.y(), -edge.x()));
    }
  }
  return angles;
}

CurvatureLimitElement curvatureElement(const LimitedTriangle& triangle, const TriangleStencil& stencil,
                                       std::size_t index) {
  const Matrix2d edges = restEdges(triangle, index);
  CurvatureLimitElement element;
  element.set = triangle.bending;
  element.area = 0.5 * edges.determinant();
  bool isInside = true;
  for (int i = 0; i < 3; ++i) {
    element.hasNeighbour[i] = stencil.hasNeighbour(i);
    isInside = isInside && element.hasNeighbour[i];
    const Vector2d edge = triangle.rest.col((i + 2) % 3) - triangle.rest.col((i + 1) % 3);
    const Vector2d outward(edge.y(), -edge.x());
    element.curvatureOfAngles.col(i) =
        strainVector(outward * outward.transpose()) * (-1 / (2 * element.area * edge.norm()));
  }
  if (!isInside) return element;
  const Matrix3d inverse = anglesOfCurvature(stencil).inverse();
  if (inverse.allFinite() && inverse.norm() < largestAmplification * element.curvatureOfAngles.norm())
    element.curvatureOfAngles = inverse;
  return element;
}

template <std::size_t nodes>
std::array<int, 3 * nodes> coordinatesOf(const std::array<int, nodes>& list) {
  std::array<int, 3 * nodes> result;
  for (std::size_t k = 0; k < nodes; ++k)
    for (int i = 0; i < 3; ++i) result[3 * k + i] = 3 * list[k] + i;
  return result;
}

template <std::size_t count>
std::array<double, count> gather(const std::array<int, count>& coordinates, const Vector& x) {
  std::array<double, count> at;
  for (std::size_t i = 0; i < count; ++i) at[i] = x[coordinates[i]];
  return at;
}

}  // namespace

std::shared_ptr<const Energy> makeStretchLimit(const std::vector<LimitedTriangle>& triangles,
                                               const StrainLimitFunction& function) {
  std::vector<StretchLimitElement> elements;
  std::vector<std::array<int, 9>> coordinates;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!triangles[t].stretch) continue;
    elements.push_back(stretchElement(triangles[t], t));
    elements.back().function = function;
    coordinates.push_back(coordinatesOf(triangles[t].nodes));
  }
  if (elements.empty()) return nullptr;
  return std::make_shared<ElementEnergy<StretchLimitElement>>(std::move(elements), std::move(coordinates));
}

std::shared_ptr<const Energy> makeCurvatureLimit(const std::vector<LimitedTriangle>& triangles,
                                                 const StrainLimitFunction& function) {
  const std::vector<TriangleStencil> around = triangleStencils(triangles);
  std::vector<CurvatureLimitElement> elements;
  std::vector<std::array<int, 18>> coordinates;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!triangles[t].bending) continue;
    elements.push_back(curvatureElement(triangles[t], around[t], t));
    elements.back().function = function;
    coordinates.push_back(coordinatesOf(around[t].nodes));
  }
  if (elements.empty()) return nullptr;
  return std::make_shared<ElementEnergy<CurvatureLimitElement>>(std::move(elements), std::move(coordinates));
}

SheetStrains sheetStrains(const std::vector<LimitedTriangle>& triangles, const Vector& x) {
  const std::vector<TriangleStencil> around = triangleStencils(triangles);
  SheetStrains result;
  result.stretch.resize(3, static_cast<Eigen::Index>(triangles.size()));
  result.curvature.resizeLike(result.stretch);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto column = static_cast<Eigen::Index>(t);
    result.stretch.col(column) = stretchElement(triangles[t], t).strain(gather(coordinatesOf(triangles[t].nodes), x));
    result.curvature.col(column) =
        curvatureElement(triangles[t], around[t], t).curvature(gather(coordinatesOf(around[t].nodes), x));
  }
  return result;
}

}  // namespace pliant::mechanics
