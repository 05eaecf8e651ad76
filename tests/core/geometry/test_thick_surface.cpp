#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/geometry/thick_surface.hpp"

using namespace pliant::geometry;
using Eigen::Vector3d;
using std::numbers::pi;

namespace {

/// Points less edges plus triangles of a closed mesh.
int eulerOf(const SurfaceMesh& mesh) {
  return static_cast<int>(mesh.points.cols()) - static_cast<int>(mesh.triangles.size() / 2);
}

std::vector<double> evenly(const SurfaceMesh& mesh, double thickness) {
  return std::vector<double>(mesh.triangles.size(), thickness);
}

/// A strip of `sides` flat rows, whose rows turn by `turn` from one to the next, each `width` long and 1 deep.
SurfaceMesh bentStrip(int sides, double width, double turn) {
  SurfaceMesh mesh = makeGrid(sides, 1, sides, 3);
  Vector3d corner = Vector3d::Zero();
  std::vector<Vector3d> corners{corner};
  for (int i = 0; i < sides; ++i)
    corners.push_back(corner += width * Vector3d(std::cos(i * turn), 0, std::sin(i * turn)));
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    const Vector3d& place = corners[static_cast<std::size_t>(std::lround(mesh.points(0, i)))];
    mesh.points(0, i) = place[0], mesh.points(2, i) = place[2];
  }
  return mesh;
}

std::string refusalOf(const auto& work) {
  try {
    work();
  } catch (const pliant::base::InputError& error) {
    return error.problem();
  }
  return {};
}

}  // namespace

class TestThickSurface : public QObject {
  Q_OBJECT

 private slots:
  void flatSquareIsExact() {
    const SurfaceMesh square = makeGrid(2, 3, 4, 5), solid = thickenSurface(square, evenly(square, 0.25));
    checkSolid(solid);
    QCOMPARE(eulerOf(solid), 2);
    QVERIFY(std::abs(enclosedVolume(solid) - 2 * 3 * 0.25) < 1e-14);
    QCOMPARE(solid.points.row(2).maxCoeff(), 0.125);
    QCOMPARE(solid.points.row(2).minCoeff(), -0.125);
  }

  /// A plate with a hole is a ring: genus 1. A closed surface becomes a shell around a hollow: two spheres.
  void genus() {
    SurfaceMesh ring = makeGrid(3, 3, 3, 3);
    std::erase_if(ring.triangles, [&](const auto& triangle) {
      Vector3d middle = Vector3d::Zero();
      for (const int point : triangle) middle += ring.points.col(point) / 3;
      return std::abs(middle[0] - 1.5) < 0.5 && std::abs(middle[1]) < 0.5;
    });
    const SurfaceMesh solid = thickenSurface(ring, evenly(ring, 0.1));
    checkSolid(solid);
    QCOMPARE(eulerOf(solid), 0);
    QVERIFY(std::abs(enclosedVolume(solid) - 0.8) < 1e-14);

    SurfaceMesh octahedron;
    octahedron.points.resize(3, 6);
    octahedron.points << Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity();
    octahedron.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
    const SurfaceMesh hollow = thickenSurface(octahedron, evenly(octahedron, 0.1));
    checkSolid(hollow);
    QCOMPARE(eulerOf(hollow), 4);
    // Both sides are octahedra whose faces are 0.05 nearer and farther; a face of the middle one is 1/√3 away.
    const double inner = 1 - 0.05 * std::sqrt(3), outer = 1 + 0.05 * std::sqrt(3);
    QVERIFY(std::abs(enclosedVolume(hollow) - 4.0 / 3 * (outer * outer * outer - inner * inner * inner)) < 1e-13);
  }

  /// Where a strip bends, its rows keep their thickness: each is a trapezoid, shorter inside than outside by as much.
  void mitredFolds() {
    const double thickness = 0.2;
    const SurfaceMesh strip = bentStrip(6, 1, pi / 8), solid = thickenSurface(strip, evenly(strip, thickness));
    checkSolid(solid);
    QVERIFY(std::abs(enclosedVolume(solid) - 6 * thickness) < 1e-13);
  }

  /// A thickness that grows along x, as each row's own: the mean of two rows where they meet.
  void thicknessOfEachTriangle() {
    const SurfaceMesh strip = makeGrid(4, 1, 4, 1);
    std::vector<double> thickness;
    for (const auto& triangle : strip.triangles) {
      double x = 0;
      for (const int point : triangle) x += strip.points(0, point) / 3;
      thickness.push_back(0.1 * (1 + std::floor(x)));
    }
    const SurfaceMesh solid = thickenSurface(strip, thickness);
    checkSolid(solid);
    const double mean[] = {0.1, 0.15, 0.25, 0.35, 0.4};  // at x = 0 to 4
    double volume = 0;
    for (int i = 0; i < 4; ++i) volume += 0.5 * (mean[i] + mean[i + 1]);
    QVERIFY(std::abs(enclosedVolume(solid) - volume) < 1e-14);
  }

  void neighboursOfOtherOrientation() {
    SurfaceMesh square = makeGrid(1, 1, 2, 2);
    std::swap(square.triangles[3][0], square.triangles[3][1]);
    const SurfaceMesh solid = thickenSurface(square, evenly(square, 0.1));
    checkSolid(solid);
    QVERIFY(std::abs(enclosedVolume(solid) - 0.1) < 1e-15);
  }

  void refusals() {
    SurfaceMesh fin = makeGrid(1, 1, 1, 1);
    fin.points.conservativeResize(3, 5);
    fin.points.col(4) = Vector3d(0, 0, 1);
    const std::array<int, 3> triangle = fin.triangles[0];
    fin.triangles.push_back({triangle[0], triangle[1], 4});
    fin.triangles.push_back({triangle[1], triangle[2], 4});
    fin.triangles.push_back({triangle[2], triangle[0], 4});
    QVERIFY(refusalOf([&] { thickenSurface(fin, evenly(fin, 0.1)); }).find("an edge may have two") !=
            std::string::npos);

    SurfaceMesh bow;
    bow.points = (Eigen::Matrix3Xd(3, 5) << 0, 1, 1, -1, -1, 0, 1, -1, 1, -1, 0, 0, 0, 0, 0).finished();
    bow.triangles = {{0, 1, 2}, {0, 3, 4}};
    QVERIFY(refusalOf([&] { thickenSurface(bow, evenly(bow, 0.1)); }).find("touches itself") != std::string::npos);

    const SurfaceMesh square = makeGrid(1, 1, 1, 1);
    QVERIFY(refusalOf([&] { thickenSurface(square, evenly(square, 0)); }).find("above 0") != std::string::npos);
  }

  /// What checkSolid is there for: an open mesh, one inside out, and two boxes that run into each other.
  void checksFind() {
    const SurfaceMesh square = makeGrid(1, 1, 1, 1);
    QVERIFY(refusalOf([&] { checkSolid(square); }).find("open") != std::string::npos);
    const SurfaceMesh box = thickenSurface(square, evenly(square, 1));
    SurfaceMesh inside = box;
    for (auto& triangle : inside.triangles) std::swap(triangle[0], triangle[1]);
    QVERIFY(refusalOf([&] { checkSolid(inside); }).find("inwards") != std::string::npos);
    SurfaceMesh both = box;
    const int count = static_cast<int>(box.points.cols());
    both.points.conservativeResize(3, 2 * count);
    both.points.rightCols(count) = box.points.colwise() + Vector3d(0.4, 0.3, 0.2);
    for (const auto& [a, b, c] : box.triangles) both.triangles.push_back({a + count, b + count, c + count});
    checkClosed(both);
    QVERIFY(refusalOf([&] { checkSolid(both); }).find("runs into itself: the edge between points") !=
            std::string::npos);
    // A surface that bends more sharply than its thickness allows does the same.
    const SurfaceMesh tight = bentStrip(6, 0.05, pi / 6);
    QVERIFY(!refusalOf([&] { checkSolid(thickenSurface(tight, evenly(tight, 0.4))); }).empty());
  }
};

QTEST_GUILESS_MAIN(TestThickSurface)
#include "test_thick_surface.moc"
