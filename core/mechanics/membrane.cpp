#include <Eigen/Dense>

#include "core/mechanics/membrane_element.hpp"
#include "core/mechanics/shell.hpp"
#include "core/mechanics/shell_checks.hpp"

namespace pliant::mechanics {

namespace {

template <int dimension>
MembraneElement<dimension> makeElement(const Vector& rest, const std::array<int, 3>& triangle,
                                       const ShellMaterial& material, double stiffnessFactor, double thicknessFactor) {
  const auto point = [&](int corner) { return rest.segment<dimension>(triangle[corner] * dimension); };
  const Eigen::Matrix<double, dimension, 1> e1 = point(1) - point(0), e2 = point(2) - point(0);

  // Rest edges in the triangle's own frame: the columns of the upper triangular matrix R with RᵀR = their metric.
  Eigen::Matrix2d edges = Eigen::Matrix2d::Zero();
  edges(0, 0) = e1.norm();
  edges(0, 1) = e1.dot(e2) / edges(0, 0);
  edges(1, 1) = (e2 - e1 * (edges(0, 1) / edges(0, 0))).norm();
  const double area = 0.5 * edges.determinant();
  const Eigen::Matrix2d b = edges.inverse();

  // (ε₁₁, ε₂₂, ε₁₂) = strain (a - a₀), with ε = ½ bᵀ (metric - rest metric) b.
  Eigen::Matrix3d strain;
  const auto row = [&](int i, int j) -> Eigen::RowVector3d {
    return 0.5 * Eigen::RowVector3d(b(0, i) * b(0, j), b(1, i) * b(1, j), b(0, i) * b(1, j) + b(1, i) * b(0, j));
  };
  strain << row(0, 0), row(1, 1), row(0, 1);
  const double nu = material.poissonRatio;
  Eigen::Matrix3d law;  // E = ½ (ε₁₁, ε₂₂, ε₁₂) law (...)ᵀ
  law << 1, nu, 0, nu, 1, 0, 0, 0, 2 * (1 - nu);
  law *= stiffnessFactor * thicknessFactor * area * material.thickness * material.youngModulus / (1 - nu * nu);
  const Eigen::Matrix3d q = strain.transpose() * law * strain;

  MembraneElement<dimension> element;
  element.restMetric = {e1.squaredNorm(), e2.squaredNorm(), e1.dot(e2)};
  const double young = stiffnessFactor * material.youngModulus;
  element.material = {area * material.thickness * thicknessFactor, young * nu / (1 - nu * nu), young / (1 + nu)};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) element.stiffness[packedIndex(i, j)] = q(i, j);
  return element;
}

template <int dimension>
std::shared_ptr<const Energy> makeMembraneOf(const Vector& rest, const Triangles& triangles, const Triangles& corners,
                                             const ShellMaterial& material, const TriangleFactors& factors) {
  std::vector<MembraneElement<dimension>> elements;
  std::vector<std::array<int, 3 * dimension>> coordinates;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& triangle = triangles[t];
    elements.push_back(makeElement<dimension>(
        rest, corners[t], material, factorOf(factors.stiffness, t), factorOf(factors.thickness, t)));
    auto& indices = coordinates.emplace_back();
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < dimension; ++axis)
        indices[corner * dimension + axis] = triangle[corner] * dimension + axis;
  }
  return std::make_shared<ElementEnergy<MembraneElement<dimension>>>(std::move(elements), std::move(coordinates));
}

}  // namespace

std::shared_ptr<const Energy> makeMembrane(int dimension, const Vector& restPositions, const Triangles& triangles,
                                           const ShellMaterial& material, const TriangleFactors& factors,
                                           const Triangles& restTriangles) {
  requireElasticMaterial(material);
  const Triangles& corners = restCorners(triangles, restTriangles);
  requireTriangles(dimension, restPositions, corners);
  requireTriangleFactors(factors, triangles);
  return dimension == 2 ? makeMembraneOf<2>(restPositions, triangles, corners, material, factors)
                        : makeMembraneOf<3>(restPositions, triangles, corners, material, factors);
}

}  // namespace pliant::mechanics
