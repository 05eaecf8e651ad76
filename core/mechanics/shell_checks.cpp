#include "core/mechanics/shell_checks.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/mechanics/checks.hpp"

namespace pliant::mechanics {

void requireElasticMaterial(const ShellMaterial& material) {
  requirePositive(material.youngModulus, "Young's modulus");
  requirePositive(material.thickness, "the thickness");
  const double nu = material.poissonRatio;
  if (!(nu > -1 && nu <= 0.5))
    throw base::InputError("", "Poisson's ratio must be above -1 and at most 0.5, but is " + std::to_string(nu));
}

void requireTriangles(int dimension, const Vector& restPositions, const Triangles& triangles) {
  requireDimension(dimension, "a shell", 2);
  requireVector(restPositions, static_cast<int>(restPositions.size()), "the rest positions");
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::string what = "triangle " + std::to_string(t);
    requireNodes(triangles[t], static_cast<int>(restPositions.size()) / dimension, what);
    double longest = 0;
    for (int i = 0; i < 3; ++i)
      longest = std::max(longest, (restPositions.segment(triangles[t][i] * dimension, dimension) -
                                   restPositions.segment(triangles[t][(i + 1) % 3] * dimension, dimension))
                                      .squaredNorm());
    if (!(triangleArea(dimension, restPositions, triangles[t]) > geometry::smallestRelativeArea * longest))
      throw base::InputError("", what + " has no area");
  }
}

const Triangles& restCorners(const Triangles& triangles, const Triangles& restTriangles) {
  if (restTriangles.empty()) return triangles;
  if (restTriangles.size() != triangles.size())
    throw base::InputError("", "there are " + std::to_string(restTriangles.size()) + " triangles at rest for " +
                                   std::to_string(triangles.size()) + " triangles");
  return restTriangles;
}

void requireTriangleFactors(const TriangleFactors& factors, const Triangles& triangles) {
  requireFactors(factors.stiffness, triangles.size());
  requireFactors(factors.thickness, triangles.size());
}

double triangleArea(int dimension, const Vector& restPositions, const std::array<int, 3>& triangle) {
  const auto point = [&](int corner) { return restPositions.segment(triangle[corner] * dimension, dimension); };
  const Vector e1 = point(1) - point(0), e2 = point(2) - point(0);
  const double along = e1.norm();
  if (!(along > 0)) return 0;
  return 0.5 * along * (e2 - e1 * (e1.dot(e2) / (along * along))).norm();
}

}  // namespace pliant::mechanics
