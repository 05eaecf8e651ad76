#include "core/mechanics/checks.hpp"
#include "core/mechanics/shell.hpp"
#include "core/mechanics/shell_checks.hpp"

namespace pliant::mechanics {

void addShellMass(int dimension, const Vector& restPositions, const Triangles& triangles, const ShellMaterial& material,
                  MassMatrix kind, std::vector<Eigen::Triplet<double>>& entries, const TriangleFactors& factors,
                  const Triangles& restTriangles) {
  requirePositive(material.density, "the density");
  requirePositive(material.thickness, "the thickness");
  const Triangles& corners = restCorners(triangles, restTriangles);
  requireTriangles(dimension, restPositions, corners);
  requireTriangleFactors(factors, triangles);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& triangle = triangles[t];
    const double mass = material.density * material.thickness * factorOf(factors.thickness, t) *
                        triangleArea(dimension, restPositions, corners[t]);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        // Consistent: the integral of the linear shape functions' products. Lumped: its row sums.
        if (kind == MassMatrix::lumped && a != b) continue;
        const double share = kind == MassMatrix::lumped ? mass / 3 : mass / (a == b ? 6 : 12);
        for (int axis = 0; axis < dimension; ++axis)
          entries.emplace_back(triangle[a] * dimension + axis, triangle[b] * dimension + axis, share);
      }
  }
}

}  // namespace pliant::mechanics
