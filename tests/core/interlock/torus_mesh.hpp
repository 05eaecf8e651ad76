#pragma once

#include <cmath>
#include <numbers>

#include "core/geometry/surface_mesh.hpp"

/// A ring about the z axis whose corners lie on the torus of the radii R and r [m]: `around` sections of `across`
/// corners each. The first section is at the angle `turn`, the first corner of a section at `sectionTurn` from the
/// outermost place.
inline pliant::geometry::SurfaceMesh torusMesh(double ringRadius, double wireRadius, int around, int across,
                                               double turn = 0, double sectionTurn = 0) {
  pliant::geometry::SurfaceMesh mesh;
  mesh.points.resize(3, Eigen::Index{around} * across);
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const double angle = turn + 2 * std::numbers::pi * i / around,
                   section = sectionTurn + 2 * std::numbers::pi * k / across;
      const double out = ringRadius + wireRadius * std::cos(section);
      mesh.points.col(Eigen::Index{i} * across + k) =
          Eigen::Vector3d(out * std::cos(angle), out * std::sin(angle), wireRadius * std::sin(section));
    }
  const auto at = [&](int i, int k) { return (i % around) * across + k % across; };
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return mesh;
}
