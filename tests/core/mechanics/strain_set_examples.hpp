#pragma once

#include <functional>
#include <map>

#include "core/mechanics/admissible_strain_set.hpp"

namespace pliant::mechanics {

/// A sphere of directions cut from an octahedron, each triangle into four `subdivisions` times.
inline geometry::SurfaceMesh directionMesh(int subdivisions) {
  std::vector<Eigen::Vector3d> points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  geometry::SurfaceMesh mesh;
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int k = 0; k < subdivisions; ++k) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [found, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (isNew) points.push_back((points[a] + points[b]).normalized());
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  mesh.points.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) mesh.points.col(static_cast<Eigen::Index>(i)) = points[i];
  return mesh;
}

/// The set around `middle` that reaches `radius`(direction) far.
inline std::shared_ptr<const AdmissibleStrainSet> strainSet(const std::function<double(const Eigen::Vector3d&)>& radius,
                                                            const Eigen::Vector3d& middle = Eigen::Vector3d::Zero(),
                                                            int subdivisions = 3) {
  geometry::SurfaceMesh mesh = directionMesh(subdivisions);
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    mesh.points.col(i) = middle + radius(mesh.points.col(i)) * mesh.points.col(i);
  return std::make_shared<const AdmissibleStrainSet>(std::move(mesh), middle);
}

}  // namespace pliant::mechanics
