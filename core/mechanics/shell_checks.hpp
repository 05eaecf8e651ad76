#pragma once

#include "core/mechanics/shell.hpp"

namespace pliant::mechanics {

/// Young's modulus and thickness above 0, Poisson's ratio above -1 and at most 0.5. Throws base::InputError.
void requireElasticMaterial(const ShellMaterial& material);

/// Finite positions, node indices in range, no triangle of zero area. Throws base::InputError naming the triangle.
void requireTriangles(int dimension, const Vector& restPositions, const Triangles& triangles);

/// Where corners rest: `restTriangles`, one for each triangle, or `triangles` themselves if there are none. Throws
/// base::InputError if the numbers differ.
const Triangles& restCorners(const Triangles& triangles, const Triangles& restTriangles);

/// As many factors as triangles, or none, all above 0. Throws base::InputError.
void requireTriangleFactors(const TriangleFactors& factors, const Triangles& triangles);

/// The factor of one triangle: 1 if there are none.
inline double factorOf(std::span<const double> factors, std::size_t triangle) {
  return factors.empty() ? 1 : factors[triangle];
}

/// Rest area of a triangle [m²].
double triangleArea(int dimension, const Vector& restPositions, const std::array<int, 3>& triangle);

}  // namespace pliant::mechanics
