#include <QTest>
#include <cmath>

#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/mesh_kernel.hpp"

using namespace pliant;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::KernelPoint;
using geometry::SurfaceMesh;

namespace {

/// A prism of height 1 over a polygon (counterclockwise) whose triangles are given.
SurfaceMesh prism(const std::vector<Vector2d>& corners, const std::vector<std::array<int, 3>>& caps) {
  const int n = static_cast<int>(corners.size());
  SurfaceMesh mesh;
  mesh.points.resize(3, 2 * n);
  for (int i = 0; i < n; ++i) {
    mesh.points.col(i) << corners[static_cast<std::size_t>(i)], 0;
    mesh.points.col(n + i) << corners[static_cast<std::size_t>(i)], 1;
  }
  for (const auto& [a, b, c] : caps) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({n + a, n + b, n + c});
  }
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.triangles.push_back({i, next, n + next});
    mesh.triangles.push_back({i, n + next, n + i});
  }
  geometry::checkClosed(mesh);
  return mesh;
}

}  // namespace

class TestMeshKernel : public QObject {
  Q_OBJECT

 private slots:
  void middleOfABox() {
    const KernelPoint kernel =
        geometry::deepestKernelPoint(prism({{0, 0}, {3, 0}, {3, 2}, {0, 2}}, {{0, 1, 2}, {0, 2, 3}}));
    QVERIFY(std::abs(kernel.depth - 0.5) < 1e-6);
    QVERIFY(std::abs(kernel.point.z() - 0.5) < 1e-6);
  }

  /// Two arms that meet in a square, from where alone both are seen: the deepest point of the square is its middle.
  void cornerOfAnL() {
    const double w = 0.4;
    const SurfaceMesh mesh =
        prism({{0, 0}, {3, 0}, {3, w}, {w, w}, {w, 2}, {0, 2}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
    const Vector3d centroid = geometry::enclosedCentroid(mesh);
    QVERIFY(centroid.x() > w);  // from where not all is seen
    const KernelPoint kernel = geometry::deepestKernelPoint(mesh);
    QVERIFY(std::abs(kernel.depth - 0.5 * w) < 1e-6);
    QVERIFY((kernel.point.head<2>() - Vector2d(0.5 * w, 0.5 * w)).norm() < 1e-4);
  }

  /// The inside of neither arm of a U sees the other's: planes x = 1 and x = 2 bound what does from opposite sides, so
  /// that the least bad point is half-way beyond both.
  void uHasNone() {
    const SurfaceMesh mesh = prism({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},
                                   {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}, {0, 5, 6}, {0, 6, 7}});
    const KernelPoint kernel = geometry::deepestKernelPoint(mesh);
    QVERIFY(std::abs(kernel.depth + 0.5) < 1e-6);
  }
};

QTEST_APPLESS_MAIN(TestMeshKernel)
#include "test_mesh_kernel.moc"
