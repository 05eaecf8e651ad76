#include <Eigen/Geometry>
#include <cmath>

#include "core/geometry/surface_mesh.hpp"
#include "core/mechanics/hinge_element.hpp"
#include "core/mechanics/shell.hpp"
#include "core/mechanics/shell_checks.hpp"

namespace pliant::mechanics {

namespace {

/// The corner of a triangle that is not on the edge.
int cornerOpposite(const std::array<int, 3>& triangle, const std::array<int, 2>& edge) {
  for (const int node : triangle)
    if (node != edge[0] && node != edge[1]) return node;
  return -1;
}

double dihedralAngle(const Vector& x, const std::array<int, 4>& nodes) {
  const auto point = [&](int i) { return x.segment<3>(3 * nodes[i]); };
  const Eigen::Vector3d e = point(1) - point(0), u = point(2) - point(0), v = point(3) - point(0);
  const Eigen::Vector3d n1 = e.cross(u), n2 = v.cross(e);
  return std::atan2(-e.norm() * n1.dot(v), n1.dot(n2));
}

double bendingFactor(const TriangleFactors& factors, int triangle) {
  const auto t = static_cast<std::size_t>(triangle);
  return factorOf(factors.stiffness, t) * std::pow(factorOf(factors.thickness, t), 3);
}

}  // namespace

std::shared_ptr<const Energy> makeHingeBending(const Vector& restPositions, const Triangles& triangles,
                                               const ShellMaterial& material, const TriangleFactors& factors) {
  requireElasticMaterial(material);
  requireTriangles(3, restPositions, triangles);
  requireTriangleFactors(factors, triangles);
  const double rigidity = material.youngModulus * std::pow(material.thickness, 3) /
                          (12 * (1 - material.poissonRatio * material.poissonRatio));
  std::vector<HingeElement> elements;
  std::vector<std::array<int, 12>> coordinates;
  for (const geometry::MeshEdge& edge : geometry::meshEdges(triangles)) {
    const auto [left, right] = edge.triangles;
    if (left < 0 || right < 0) continue;
    const std::array<int, 4> nodes = {edge.nodes[0], edge.nodes[1], cornerOpposite(triangles[left], edge.nodes),
                                      cornerOpposite(triangles[right], edge.nodes)};
    const double squaredLength =
        (restPositions.segment<3>(3 * nodes[1]) - restPositions.segment<3>(3 * nodes[0])).squaredNorm();
    const double areaLeft = triangleArea(3, restPositions, triangles[left]);
    const double areaRight = triangleArea(3, restPositions, triangles[right]);
    const double area = areaLeft + areaRight;
    const double factor = (areaLeft * bendingFactor(factors, left) + areaRight * bendingFactor(factors, right)) / area;
    elements.push_back({0.5 * factor * rigidity * squaredLength / area, dihedralAngle(restPositions, nodes)});
    auto& indices = coordinates.emplace_back();
    for (int i = 0; i < 12; ++i) indices[i] = nodes[i / 3] * 3 + i % 3;
  }
  if (elements.empty()) return nullptr;
  return std::make_shared<ElementEnergy<HingeElement>>(std::move(elements), std::move(coordinates));
}

}  // namespace pliant::mechanics
