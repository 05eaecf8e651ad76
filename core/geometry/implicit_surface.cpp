#include "core/geometry/implicit_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/editable_mesh.hpp"

namespace pliant::geometry {

namespace {

using Eigen::Vector3d;
using Place = std::array<int, 3>;  ///< of a corner or cube of the grid

/// A tetrahedron's corners in an even order: those inside first.
constexpr std::array<std::array<int, 4>, 4> oneFirst = {{{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 1, 3}, {3, 0, 2, 1}}};
constexpr std::array<std::array<int, 4>, 6> twoFirst = {
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

class MarchingTetrahedra {
 public:
  MarchingTetrahedra(const BodyDistance& body, const Eigen::AlignedBox3d& box, double cell)
      : body_(body), cell_(cell), origin_(box.min() - Vector3d::Constant(1.37 * cell)) {
    int levels = 0;
    while (levels < maximumLevels && std::ldexp(cell, levels) < box.sizes().maxCoeff() + 3 * cell) ++levels;
    if (levels == maximumLevels) tooFine();
    collect({0, 0, 0}, levels);
  }

  SurfaceMesh run() {
    for (const Place& cube : cubes_) cut(cube);
    SurfaceMesh mesh;
    mesh.points.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i) mesh.points.col(static_cast<Eigen::Index>(i)) = points_[i];
    mesh.triangles = std::move(triangles_);
    return mesh;
  }

 private:
  static constexpr int maximumLevels = 20;
  static constexpr std::size_t mostCubes = 5'000'000;

  [[noreturn]] static void tooFine() {
    throw base::InputError("", "the surface is too fine for its size: it would take more than five million cubes");
  }

  Vector3d placeOf(const Place& corner) const { return origin_ + cell_ * Vector3d(corner[0], corner[1], corner[2]); }

  /// The smallest cubes that the surface may pass.
  void collect(const Place& first, int level) {
    const double size = std::ldexp(cell_, level);
    const Vector3d middle = placeOf(first) + Vector3d::Constant(0.5 * size);
    if (std::abs(body_(middle).distance) > 0.5 * std::sqrt(3.0) * size * (1 + 1e-9)) return;
    if (level == 0) {
      if (cubes_.size() == mostCubes) tooFine();
      cubes_.push_back(first);
      return;
    }
    const int half = 1 << (level - 1);
    for (int child = 0; child < 8; ++child)
      collect({first[0] + half * (child & 1), first[1] + half * (child >> 1 & 1), first[2] + half * (child >> 2)},
              level - 1);
  }

  static std::uint64_t keyOf(const Place& corner) {
    return static_cast<std::uint64_t>(corner[0]) << 42 | static_cast<std::uint64_t>(corner[1]) << 21 |
           static_cast<std::uint64_t>(corner[2]);
  }

  double distanceAt(const Place& corner) {
    const auto [entry, isNew] = distances_.try_emplace(keyOf(corner), 0.0);
    if (isNew) entry->second = body_(placeOf(corner)).distance;
    return entry->second;
  }

  /// The point where the surface crosses the edge from an inner corner to an outer one.
  int crossing(const Place& inner, const Place& outer) {
    // Edges of a cube's tetrahedra go in one of seven directions from the lower of their corners.
    const Place& low = inner < outer ? inner : outer;
    const Place& high = inner < outer ? outer : inner;
    const int direction = (high[0] - low[0]) | (high[1] - low[1]) << 1 | (high[2] - low[2]) << 2;
    auto& points = crossings_[keyOf(low)];
    if (points[direction] != 0) return points[direction] - 1;
    const Vector3d from = placeOf(inner), to = placeOf(outer);
    // By the Illinois method: halving the value kept at an end that does not move.
    double low01 = 0, high01 = 1, lowValue = distanceAt(inner), highValue = distanceAt(outer), at = 0.5;
    int side = 0;
    for (int i = 0; i < 40; ++i) {
      at = (low01 * highValue - high01 * lowValue) / (highValue - lowValue);
      const double value = body_(from + at * (to - from)).distance;
      if (std::abs(value) < 1e-9 * cell_) break;
      if (value < 0) {
        low01 = at, lowValue = value;
        if (side < 0) highValue *= 0.5;
        side = -1;
      } else {
        high01 = at, highValue = value;
        if (side > 0) lowValue *= 0.5;
        side = 1;
      }
    }
    points_.push_back(from + at * (to - from));
    points[direction] = static_cast<int>(points_.size());
    return points[direction] - 1;
  }

  void cut(const Place& cube) {
    int inside = 0;
    for (int i = 0; i < 8; ++i)
      inside += distanceAt({cube[0] + (i & 1), cube[1] + (i >> 1 & 1), cube[2] + (i >> 2)}) < 0;
    if (inside == 0 || inside == 8) return;
    // Kuhn's tetrahedra: from the lowest corner to the highest along the axes in all orders.
    Place axes = {0, 1, 2};
    do {
      std::array<Place, 4> corners;
      corners[0] = cube;
      for (int i = 0; i < 3; ++i) {
        corners[i + 1] = corners[i];
        ++corners[i + 1][axes[i]];
      }
      const bool even = (axes[1] - axes[0] + 3) % 3 == 1;
      if (!even) std::swap(corners[0], corners[1]);
      cutTetrahedron(corners);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  /// Corners in positive orientation.
  void cutTetrahedron(const std::array<Place, 4>& corners) {
    std::array<bool, 4> inside;
    int count = 0;
    for (int i = 0; i < 4; ++i) count += inside[i] = distanceAt(corners[i]) < 0;
    const auto edge = [&](int a, int b) {
      return inside[a] ? crossing(corners[a], corners[b]) : crossing(corners[b], corners[a]);
    };
    if (count == 1 || count == 3) {
      const bool lone = count == 1;
      for (const auto& [i, j, k, l] : oneFirst)
        if (inside[i] == lone)
          triangles_.push_back(lone ? std::array{edge(i, j), edge(i, k), edge(i, l)}
                                    : std::array{edge(i, j), edge(i, l), edge(i, k)});
    } else if (count == 2) {
      for (const auto& [i, j, k, l] : twoFirst) {
        if (!inside[i] || !inside[j]) continue;
        const std::array quad = {edge(i, k), edge(i, l), edge(j, l), edge(j, k)};
        const bool other = (points_[quad[0]] - points_[quad[2]]).norm() > (points_[quad[1]] - points_[quad[3]]).norm();
        const int first = other ? 1 : 0;
        triangles_.push_back({quad[first], quad[first + 1], quad[first + 2]});
        triangles_.push_back({quad[first], quad[first + 2], quad[(first + 3) % 4]});
      }
    }
  }

  const BodyDistance& body_;
  const double cell_;
  const Vector3d origin_;
  std::vector<Place> cubes_;
  std::unordered_map<std::uint64_t, double> distances_;
  std::unordered_map<std::uint64_t, std::array<int, 8>> crossings_;  ///< points counted from 1, by direction
  std::vector<Vector3d> points_;
  std::vector<std::array<int, 3>> triangles_;
};

/// Connected parts, each as the list of its triangles.
std::vector<std::vector<std::array<int, 3>>> partsOf(const SurfaceMesh& mesh) {
  std::vector<int> parent(mesh.points.cols());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<int>(i);
  const auto root = [&](int node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    parent[root(b)] = root(a);
    parent[root(c)] = root(a);
  }
  std::unordered_map<int, std::size_t> index;
  std::vector<std::vector<std::array<int, 3>>> parts;
  for (const auto& triangle : mesh.triangles) {
    const auto [entry, isNew] = index.try_emplace(root(triangle[0]), parts.size());
    if (isNew) parts.emplace_back();
    parts[entry->second].push_back(triangle);
  }
  return parts;
}

}  // namespace

BodyMesh meshBody(const BodyDistance& body, const Eigen::AlignedBox3d& box, double cell, double tolerance) {
  SurfaceMesh raw = MarchingTetrahedra(body, box, cell).run();
  if (raw.triangles.empty()) throw base::InputError("", "there is no body in the box");
  BodyMesh result;
  std::vector<std::array<int, 3>> kept;
  for (const auto& part : partsOf(raw)) {
    // Where parts of a body run into each other at an acute angle, the grid can see bubbles.
    if (enclosedVolume({raw.points, part, {}, {}}) <= 0) continue;
    kept.insert(kept.end(), part.begin(), part.end());
    ++result.bodies;
  }
  raw.triangles = kept;
  EditableMesh mesh(raw);
  for (int pass = 0; pass < 3; ++pass) {
    mesh.collapseShortEdges(body, 0.5 * cell);
    mesh.flipEdges();
    mesh.relax(body);
  }
  result.fit = mesh.splitToTolerance(body, tolerance);
  // What is far below the tolerance could vanish where coordinates are rounded.
  mesh.collapseShortEdges(body, 0.02 * tolerance, true);
  result.mesh = mesh.finish();
  checkClosed(result.mesh);
  return result;
}

}  // namespace pliant::geometry
