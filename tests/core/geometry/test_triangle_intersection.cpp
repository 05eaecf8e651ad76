#include <Eigen/Dense>
#include <QTest>
#include <cmath>
#include <random>

#include "core/geometry/mesh_generators.hpp"
#include "core/geometry/triangle_intersection.hpp"
#include "tests/core/geometry/brute_force_intersections.hpp"

using namespace pliant::geometry;
using Eigen::Vector3d;

namespace {

Vector3d randomPoint(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  return Vector3d::NullaryExpr([&] { return coordinate(random); });
}

}  // namespace

class TestTriangleIntersection : public QObject {
  Q_OBJECT

 private slots:
  void constructedCrossings();
  void constructedMisses();
  void touchingCounts();
  void coplanarSegments();
  void degenerateTriangles();
  void farFromTheOrigin();
  void meshAgainstBruteForce();
  void flatMeshHasNone();
  void separateEdges();
};

void TestTriangleIntersection::constructedCrossings() {
  // A segment through a point that is inside the triangle by construction.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 20000; ++trial) {
    const Vector3d a = randomPoint(random), b = randomPoint(random), c = randomPoint(random);
    const double s = unit(random), t = (1 - s) * unit(random);
    const Vector3d inside = a + s * (b - a) + t * (c - a), direction = randomPoint(random);
    QVERIFY(segmentMeetsTriangle(inside + unit(random) * direction, inside - unit(random) * direction, a, b, c));
  }
}

void TestTriangleIntersection::constructedMisses() {
  // A segment through a point of the plane that is outside, and one that ends before the plane.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.001, 1);
  for (int trial = 0; trial < 20000; ++trial) {
    const Vector3d a = randomPoint(random), b = randomPoint(random), c = randomPoint(random);
    const Vector3d normal = (b - a).cross(c - a), direction = randomPoint(random);
    if (std::abs(normal.normalized().dot(direction)) < 1e-3 || normal.norm() < 1e-3) continue;
    const double s = unit(random), t = 1 - s + unit(random);
    const Vector3d outside = a + s * (b - a) + t * (c - a);
    QVERIFY(!segmentMeetsTriangle(outside + unit(random) * direction, outside - unit(random) * direction, a, b, c));
    const Vector3d inside = a + 0.3 * (b - a) + 0.3 * (c - a);
    const double gap = std::pow(10, -9 * unit(random));
    QVERIFY(!segmentMeetsTriangle(inside + gap * direction, inside + (gap + 1) * direction, a, b, c));
  }
}

void TestTriangleIntersection::touchingCounts() {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  QVERIFY(segmentMeetsTriangle({0.25, 0.25, 0}, {0.25, 0.25, 1}, a, b, c));  // an end in the triangle
  QVERIFY(segmentMeetsTriangle({0.5, 0.5, -1}, {0.5, 0.5, 1}, a, b, c));     // through a side
  QVERIFY(segmentMeetsTriangle({1, 0, -1}, {1, 0, 1}, a, b, c));             // through a corner
  QVERIFY(!segmentMeetsTriangle({0.25, 0.25, 1e-14}, {0.25, 0.25, 1}, a, b, c));
  QVERIFY(!segmentMeetsTriangle({1 + 1e-14, 0, -1}, {1 + 1e-14, 0, 1}, a, b, c));
}

void TestTriangleIntersection::coplanarSegments() {
  std::mt19937 random(3);
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Quaterniond turn = trial == 0 ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond::UnitRandom();
    const auto meets = [&](const Vector3d& p, const Vector3d& q) {
      return segmentMeetsTriangle(turn * p, turn * q, turn * a, turn * b, turn * c);
    };
    if (trial == 0) {
      QVERIFY(meets({-1, 0.2, 0}, {2, 0.2, 0}));
      QVERIFY(meets({0.1, 0.1, 0}, {0.2, 0.2, 0}));
    }
    QVERIFY(!meets({-1, -0.2, 0}, {2, -0.2, 0}));
    QVERIFY(!meets({1.2, 0, 0}, {0, 1.2, 0}));
    QVERIFY(!meets({1.1, 0, 0}, {2, 0, 0}));  // along a side
    QVERIFY(!meets({-1, 0.9, 0}, {-0.1, 2, 0}));
    QVERIFY(!meets({0.55, 0.55, 0}, {1.55, 0.35, 0}));  // only the slanted side separates them
    QVERIFY(!meets({1.5, -0.5, 0}, {2, -1, 0}));        // on the line of that side
    QVERIFY(!meets({0.55, 0.55, 0}, {1.55, 0.35, 0}));  // only the slanted side separates them
    QVERIFY(!meets({1.5, -0.5, 0}, {2, -1, 0}));        // on the line of that side
  }
}

void TestTriangleIntersection::degenerateTriangles() {
  const Vector3d a(0, 0, 0), b(1, 0, 0), half(0.5, 0, 0);
  QVERIFY(segmentMeetsTriangle({0.3, -1, 0}, {0.3, 1, 0}, a, b, half));
  QVERIFY(!segmentMeetsTriangle({1.3, -1, 0}, {1.3, 1, 0}, a, b, half));
  QVERIFY(!segmentMeetsTriangle({0.3, -1, 0.1}, {0.3, 1, 0.1}, a, b, half));
  QVERIFY(!segmentMeetsTriangle({1.5, 0, 0}, {2, 0, 0}, a, b, half));    // all on one line
  QVERIFY(!segmentMeetsTriangle({0, 0.1, 0}, {1, 0.1, 0}, a, b, half));  // parallel to it
  QVERIFY(segmentMeetsTriangle(half, half, a, b, half));
  QVERIFY(!segmentMeetsTriangle(Vector3d(2, 0, 0), Vector3d(2, 0, 0), a, a, a));
}

void TestTriangleIntersection::farFromTheOrigin() {
  const Vector3d far(1e6, -3e6, 2e6), a = far, b = far + Vector3d(1, 0, 0), c = far + Vector3d(0, 1, 0);
  QVERIFY(segmentMeetsTriangle(far + Vector3d(0.3, 0.3, -1), far + Vector3d(0.3, 0.3, 1), a, b, c));
  QVERIFY(!segmentMeetsTriangle(far + Vector3d(0.3, 0.3, 1e-6), far + Vector3d(0.3, 0.3, 1), a, b, c));
}

void TestTriangleIntersection::meshAgainstBruteForce() {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> jitter(-0.12, 0.12);
  for (int trial = 0; trial < 5; ++trial) {
    SurfaceMesh mesh = makeGrid(1, 1, 12, 12);
    for (double& coordinate : mesh.points.reshaped()) coordinate += jitter(random);
    const auto found = findIntersections(mesh.points, mesh.triangles);
    QCOMPARE(static_cast<int>(found.size()), countIntersectionsByBruteForce(mesh.points, mesh.triangles));
    QVERIFY(found.size() > 10);
  }
}

void TestTriangleIntersection::flatMeshHasNone() {
  SurfaceMesh mesh = makeGrid(0.7, 0.3, 20, 9);
  QVERIFY(findIntersections(mesh.points, mesh.triangles).empty());
  mesh.points = (Eigen::Quaterniond(1, 2, 3, 4).normalized().toRotationMatrix() * mesh.points).eval();
  QVERIFY(findIntersections(mesh.points, mesh.triangles).empty());
}

void TestTriangleIntersection::separateEdges() {
  SurfaceMesh mesh = makeGrid(1, 1, 4, 4);
  mesh.points.conservativeResize(3, 27);
  mesh.points.col(25) << 0.3, 0.1, -1;
  mesh.points.col(26) << 0.3, 0.1, 1;
  const auto found = findIntersections(mesh.points, mesh.triangles, {{25, 26}});
  QCOMPARE(found.size(), std::size_t(1));
  QVERIFY((found[0].edge == std::array{25, 26}));
}

QTEST_GUILESS_MAIN(TestTriangleIntersection)
#include "test_triangle_intersection.moc"
