#include "core/mechanics/solid.hpp"

#include <Eigen/Dense>

#include "core/base/error.hpp"
#include "core/geometry/tet_mesh.hpp"
#include "core/mechanics/checks.hpp"
#include "core/mechanics/solid_element.hpp"

namespace pliant::mechanics {

namespace {

Eigen::Matrix3d restEdges(const Vector& rest, const std::array<int, 4>& tetrahedron) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k)
    edges.col(k) = rest.segment<3>(3 * tetrahedron[k + 1]) - rest.segment<3>(3 * tetrahedron[0]);
  return edges;
}

void requireTetrahedra(const Vector& rest, const Tetrahedra& tetrahedra) {
  requireVector(rest, static_cast<int>(rest.size()), "the rest positions");
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    const std::string what = "tetrahedron " + std::to_string(t);
    requireNodes(tetrahedra[t], static_cast<int>(rest.size()) / 3, what);
    const Eigen::Matrix3d edges = restEdges(rest, tetrahedra[t]);
    const double longest = edges.colwise().norm().maxCoeff();
    if (!(std::abs(edges.determinant()) / 6 > geometry::smallestRelativeVolume * longest * longest * longest))
      throw base::InputError("", what + " has no volume");
  }
}

SolidElement makeSolidElement(const Eigen::Matrix3d& edges, double youngModulus, double poissonRatio) {
  const double lambda = youngModulus * poissonRatio / ((1 + poissonRatio) * (1 - 2 * poissonRatio));
  const double mu = youngModulus / (2 * (1 + poissonRatio));
  const double volume = std::abs(edges.determinant()) / 6;
  const Eigen::Matrix3d metric = edges.transpose() * edges;
  const Eigen::Matrix3d inverse = metric.inverse();  // raises the indices of the strain
  SolidElement element;
  element.material = {volume, lambda, 2 * mu};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) {
      element.restMetric[packedIndex(i, j)] = metric(i, j);
      for (int k = 0; k <= i; ++k)
        for (int l = 0; l <= (k == i ? j : k); ++l)
          element.stiffness[packedIndex(packedIndex(i, j), packedIndex(k, l))] =
              volume * (lambda * inverse(i, j) * inverse(k, l) +
                        mu * (inverse(i, k) * inverse(j, l) + inverse(i, l) * inverse(j, k)));
    }
  return element;
}

}  // namespace

std::shared_ptr<const Energy> makeSolid(const Vector& restPositions, const Tetrahedra& tetrahedra,
                                        const SolidMaterial& material, std::span<const double> stiffnessFactors) {
  requirePositive(material.youngModulus, "Young's modulus");
  if (!(material.poissonRatio > -1 && material.poissonRatio < 0.5))
    throw base::InputError("", "a solid's Poisson's ratio must be above -1 and below 0.5, but is " +
                                   std::to_string(material.poissonRatio));
  requireTetrahedra(restPositions, tetrahedra);
  requireFactors(stiffnessFactors, tetrahedra.size());
  std::vector<SolidElement> elements;
  std::vector<std::array<int, 12>> coordinates;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    const double factor = stiffnessFactors.empty() ? 1 : stiffnessFactors[t];
    elements.push_back(makeSolidElement(
        restEdges(restPositions, tetrahedra[t]), factor * material.youngModulus, material.poissonRatio));
    auto& indices = coordinates.emplace_back();
    for (int i = 0; i < 12; ++i) indices[i] = tetrahedra[t][i / 3] * 3 + i % 3;
  }
  return std::make_shared<ElementEnergy<SolidElement>>(std::move(elements), std::move(coordinates));
}

void addSolidMass(const Vector& restPositions, const Tetrahedra& tetrahedra, const SolidMaterial& material,
                  MassMatrix kind, std::vector<Eigen::Triplet<double>>& entries) {
  requirePositive(material.density, "the density");
  requireTetrahedra(restPositions, tetrahedra);
  for (const auto& tetrahedron : tetrahedra) {
    const double mass = material.density * std::abs(restEdges(restPositions, tetrahedron).determinant()) / 6;
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        // Consistent: the integral of the linear shape functions' products. Lumped: its row sums.
        if (kind == MassMatrix::lumped && a != b) continue;
        const double share = kind == MassMatrix::lumped ? mass / 4 : mass / (a == b ? 10 : 20);
        for (int axis = 0; axis < 3; ++axis)
          entries.emplace_back(tetrahedron[a] * 3 + axis, tetrahedron[b] * 3 + axis, share);
      }
  }
}

}  // namespace pliant::mechanics
