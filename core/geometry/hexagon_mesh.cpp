#include "core/geometry/hexagon_mesh.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/error.hpp"

namespace pliant::geometry {

namespace {

constexpr int mostRings = 800;
constexpr int sides = 6;

/// Points of ring k, 6k of them, follow one another; `place(k, i)` is where point i of it is.

SurfaceMesh ringMesh(double radius, int rings, const std::function<Eigen::Vector2d(int, int)>& place) {
  if (!(radius > 0) || !std::isfinite(radius)) throw base::InputError("", "The radius of a sheet must be above 0.");
  if (rings < 1 || rings > mostRings)
    throw base::InputError("", "A sheet has 1 to " + std::to_string(mostRings) + " rings of triangles, not " +
                                   std::to_string(rings) + ".");
  SurfaceMesh mesh;
  mesh.points.setZero(3, 1 + sides * rings * (rings + 1) / 2);
  const auto index = [](int k, int i) { return k == 0 ? 0 : 1 + sides * k * (k - 1) / 2 + i % (sides * k); };
  for (int k = 1; k <= rings; ++k)
    for (int i = 0; i < sides * k; ++i) mesh.points.block<2, 1>(0, index(k, i)) = place(k, i);
  for (int k = 1; k <= rings; ++k)
    for (int side = 0; side < sides; ++side)
      for (int i = 0; i < k; ++i) {
        const int inner = side * (k - 1) + i, outer = side * k + i;
        mesh.triangles.push_back({index(k - 1, inner), index(k, outer), index(k, outer + 1)});
        if (i + 1 < k) mesh.triangles.push_back({index(k - 1, inner), index(k, outer + 1), index(k - 1, inner + 1)});
      }
  return mesh;
}

Eigen::Vector2d onCircle(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

SurfaceMesh makeHexagon(double radius, int rings) {
  return ringMesh(radius, rings, [&](int k, int i) -> Eigen::Vector2d {
    const int side = i / k;
    const double along = static_cast<double>(i % k) / k, angle = side * std::numbers::pi / 3;
    return radius * k / rings * ((1 - along) * onCircle(angle) + along * onCircle(angle + std::numbers::pi / 3));
  });
}

SurfaceMesh makeDisk(double radius, int rings) {
  return ringMesh(radius, rings, [&](int k, int i) -> Eigen::Vector2d {
    return radius * k / rings * onCircle(std::numbers::pi * i / (3.0 * k));
  });
}

}  // namespace pliant::geometry
