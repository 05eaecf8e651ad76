#include <algorithm>
#include <cmath>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "core/base/error.hpp"
#include "core/geometry/mesh_checks.hpp"
#include "core/geometry/orientation.hpp"
#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

namespace {

using Cell = std::array<long long, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::size_t hash = 0;
    for (const long long i : cell) hash = hash * 0x9E3779B97F4A7C15ULL + static_cast<std::size_t>(i);
    return hash ^ (hash >> 29);
  }
};

/// For each point the first kept point within `tolerance` of it, as an index among the kept points, which `kept` lists.
std::vector<int> findClusters(const Eigen::Matrix3Xd& points, double tolerance, std::vector<int>& kept) {
  const Eigen::Vector3d corner = points.rowwise().minCoeff();
  const double extent = (points.rowwise().maxCoeff() - corner).maxCoeff();
  const double cellSize = std::max({tolerance, 1e-12 * extent, 1e-300});  // cell indices stay below 10^12
  std::unordered_map<Cell, std::vector<int>, CellHash> cells;
  std::vector<int> cluster(points.cols());
  for (Eigen::Index n = 0; n < points.cols(); ++n) {
    Cell home;
    for (int i = 0; i < 3; ++i) home[i] = static_cast<long long>(std::floor((points(i, n) - corner[i]) / cellSize));
    int first = static_cast<int>(kept.size());
    for (int offset = 0; offset < 27; ++offset) {
      const Cell near = {home[0] + offset % 3 - 1, home[1] + offset / 3 % 3 - 1, home[2] + offset / 9 - 1};
      const auto found = cells.find(near);
      if (found == cells.end()) continue;
      for (const int candidate : found->second)
        if ((points.col(n) - points.col(kept[candidate])).norm() <= tolerance) first = std::min(first, candidate);
    }
    cluster[n] = first;
    if (first < static_cast<int>(kept.size())) continue;
    kept.push_back(static_cast<int>(n));
    cells[home].push_back(first);
  }
  return cluster;
}

/// The clusters of some points, each once.
std::vector<int> clustersOf(const std::vector<int>& nodes, const std::vector<int>& cluster) {
  std::vector<int> result;
  std::vector<char> seen(cluster.size(), 0);
  for (const int node : nodes)
    if (!std::exchange(seen[cluster[node]], 1)) result.push_back(cluster[node]);
  return result;
}

}  // namespace

SurfaceMesh weldMesh(const SurfaceMesh& mesh, double tolerance) {
  if (!(std::isfinite(tolerance) && tolerance >= 0)) {
    std::ostringstream sentence;
    sentence << "the welding tolerance must be a finite length of at least 0, but is " << tolerance;
    throw base::InputError("", sentence.str());
  }
  checkPointsAndIndices(mesh);
  std::vector<int> kept;
  const std::vector<int> cluster = findClusters(mesh.points, tolerance, kept);
  SurfaceMesh welded;
  welded.points = mesh.points(Eigen::all, kept);
  for (const auto& [a, b, c] : mesh.triangles) welded.triangles.push_back({cluster[a], cluster[b], cluster[c]});
  for (const auto& [name, nodes] : mesh.groups) welded.groups[name] = clustersOf(nodes, cluster);
  checkMesh(welded);
  const auto oriented = orientTriangles(welded.triangles);
  welded.texture = mesh.texture;
  for (std::size_t t = 0; t < welded.texture.size(); ++t)
    if (oriented[t] != welded.triangles[t]) std::swap(welded.texture[t][1], welded.texture[t][2]);
  welded.triangles = oriented;
  return welded;
}

}  // namespace pliant::geometry
