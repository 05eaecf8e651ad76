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

CurvatureLimitElement curvatureElement(const LimitedTriangle& triangle, std::size_t index) {
  const Matrix2d edges = restEdges(triangle, index);
  CurvatureLimitElement element;
  element.set = triangle.bending;
  element.area = 0.5 * edges.determinant();
  for (int i = 0; i < 3; ++i) {
    const Vector2d edge = triangle.rest.col((i + 2) % 3) - triangle.rest.col((i + 1) % 3);
    const Vector2d outward(edge.y(), -edge.x());
    element.curvatureOfAngles.col(i) =
        strainVector(outward * outward.transpose()) * (-1 / (2 * element.area * edge.norm()));
  }
  return element;
}

std::vector<std::array<int, 6>> stencils(const std::vector<LimitedTriangle>& triangles) {
  std::vector<std::array<int, 3>> corners;
  std::vector<std::array<int, 6>> result;
  for (const LimitedTriangle& triangle : triangles) {
    const auto& [a, b, c] = corners.emplace_back(triangle.nodes);
    result.push_back({a, b, c, a, b, c});
  }
  const auto opposite = [&](int triangle, const std::array<int, 2>& edge) {
    int corner = 0;
    while (corners[triangle][corner] == edge[0] || corners[triangle][corner] == edge[1]) ++corner;
    return corner;
  };
  for (const geometry::MeshEdge& edge : geometry::meshEdges(corners)) {
    const auto [s, t] = edge.triangles;
    if (s < 0 || t < 0) continue;
    const int i = opposite(s, edge.nodes), j = opposite(t, edge.nodes);
    result[s][3 + i] = corners[t][j];
    result[t][3 + j] = corners[s][i];
  }
  return result;
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

void markNeighbours(const std::array<int, 6>& stencil, CurvatureLimitElement& element) {
  for (int i = 0; i < 3; ++i) element.hasNeighbour[i] = stencil[3 + i] != stencil[i];
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
  const std::vector<std::array<int, 6>> nodes = stencils(triangles);
  std::vector<CurvatureLimitElement> elements;
  std::vector<std::array<int, 18>> coordinates;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!triangles[t].bending) continue;
    elements.push_back(curvatureElement(triangles[t], t));
    elements.back().function = function;
    markNeighbours(nodes[t], elements.back());
    coordinates.push_back(coordinatesOf(nodes[t]));
  }
  if (elements.empty()) return nullptr;
  return std::make_shared<ElementEnergy<CurvatureLimitElement>>(std::move(elements), std::move(coordinates));
}

SheetStrains sheetStrains(const std::vector<LimitedTriangle>& triangles, const Vector& x) {
  const std::vector<std::array<int, 6>> nodes = stencils(triangles);
  SheetStrains result;
  result.stretch.resize(3, static_cast<Eigen::Index>(triangles.size()));
  result.curvature.resizeLike(result.stretch);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto column = static_cast<Eigen::Index>(t);
    result.stretch.col(column) = stretchElement(triangles[t], t).strain(gather(coordinatesOf(triangles[t].nodes), x));
    CurvatureLimitElement element = curvatureElement(triangles[t], t);
    markNeighbours(nodes[t], element);
    result.curvature.col(column) = element.curvature(gather(coordinatesOf(nodes[t]), x));
  }
  return result;
}

}  // namespace pliant::mechanics
