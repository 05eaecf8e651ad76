#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/implicit_surface.hpp"

using namespace pliant::geometry;
using Eigen::Vector3d;
using std::numbers::pi;

namespace {

SurfacePlace seenFromBall(const Vector3d& place, const Vector3d& centre, double radius) {
  const Vector3d arm = place - centre;
  const Vector3d direction = arm.norm() > 0 ? Vector3d(arm.normalized()) : Vector3d::UnitX();
  return {arm.norm() - radius, centre + radius * direction};
}

BodyDistance balls(std::vector<std::pair<Vector3d, double>> all) {
  return [all](const Vector3d& place) {
    SurfacePlace nearest{1e300, place};
    for (const auto& [centre, radius] : all)
      if (const SurfacePlace seen = seenFromBall(place, centre, radius); seen.distance < nearest.distance)
        nearest = seen;
    return nearest;
  };
}

BodyDistance torus(double ring, double wire) {
  return [=](const Vector3d& place) {
    Vector3d outward(place[0], place[1], 0);
    outward = outward.norm() > 0 ? Vector3d(outward.normalized()) : Vector3d::UnitX();
    return seenFromBall(place, ring * outward, wire);
  };
}

Eigen::AlignedBox3d boxOf(double size) { return {Vector3d::Constant(-size), Vector3d::Constant(size)}; }

int eulerCharacteristic(const SurfaceMesh& mesh) {
  return static_cast<int>(mesh.points.cols()) - static_cast<int>(mesh.triangles.size() / 2);
}

double area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * (mesh.points.col(b) - mesh.points.col(a)).cross(mesh.points.col(c) - mesh.points.col(a)).norm();
  return sum;
}

}  // namespace

class TestImplicitSurface : public QObject {
  Q_OBJECT

 private slots:
  /// Volume and area of a torus are approached with the tolerance: chords err by their square, and so does a volume.
  void torusConverges() {
    const double ring = 5, wire = 0.8, volume = 2 * pi * pi * ring * wire * wire, surface = 4 * pi * pi * ring * wire;
    for (const double tolerance : {0.04, 0.01}) {
      const BodyMesh made =
          meshBody(torus(ring, wire), boxOf(6), std::min(0.4, std::sqrt(6 * wire * tolerance)), tolerance);
      QCOMPARE(made.bodies, 1);
      QCOMPARE(made.fit.filled, 0.0);
      QVERIFY(made.fit.deviation > 0 && made.fit.deviation <= tolerance);
      QCOMPARE(eulerCharacteristic(made.mesh), 0);
      // The mesh lies within the tolerance of the surface, so its volume within that times the area.
      QVERIFY(std::abs(enclosedVolume(made.mesh) - volume) < tolerance * surface);
      QVERIFY(std::abs(area(made.mesh) - surface) < 2 * tolerance / wire * surface);
      for (Eigen::Index i = 0; i < made.mesh.points.cols(); ++i)
        QVERIFY(std::abs(torus(ring, wire)(made.mesh.points.col(i)).distance) < 0.011 * tolerance);
    }
  }

  /// Two balls that run into each other: one body with a crease, of known volume.
  void unionOfBalls() {
    const double radius = 1, apart = 1.2, tolerance = 0.01, height = radius - 0.5 * apart;
    const double cap = pi * height * height * (3 * radius - height) / 3;
    const double volume = 2 * (4 * pi / 3 - cap), surface = 2 * (4 * pi - 2 * pi * height);
    const BodyMesh made =
        meshBody(balls({{{-0.5 * apart, 0, 0}, radius}, {{0.5 * apart, 0, 0}, radius}}), boxOf(2), 0.25, tolerance);
    QCOMPARE(made.bodies, 1);
    QCOMPARE(eulerCharacteristic(made.mesh), 2);
    QVERIFY(std::abs(enclosedVolume(made.mesh) - volume) < tolerance * surface);
    QVERIFY(made.fit.deviation <= tolerance);
  }

  /// Apart they are two bodies; a hollow ball is one, since bubbles are filled.
  void bodiesAreCounted() {
    const BodyMesh two = meshBody(balls({{{-2, 0, 0}, 1}, {{2, 0, 0}, 0.7}}), boxOf(4), 0.25, 0.01);
    QCOMPARE(two.bodies, 2);
    QCOMPARE(eulerCharacteristic(two.mesh), 4);
    const BodyDistance hollow = [](const Vector3d& place) {
      const double depth = place.norm();
      const Vector3d direction = depth > 0 ? Vector3d(place / depth) : Vector3d::UnitX();
      return depth > 0.75 ? SurfacePlace{depth - 1, direction} : SurfacePlace{0.5 - depth, 0.5 * direction};
    };
    const BodyMesh filled = meshBody(hollow, boxOf(1.5), 0.2, 0.01);
    QCOMPARE(filled.bodies, 1);
    QVERIFY(std::abs(enclosedVolume(filled.mesh) - 4 * pi / 3) < 0.01 * 4 * pi);
  }

  /// An opening far narrower than the cubes is filled, and said to be: two balls that nearly touch.
  void narrowOpenings() {
    const BodyDistance ringAndBall = [](const Vector3d& place) {
      const SurfacePlace a = torus(2, 0.5)(place), b = seenFromBall(place, Vector3d::Zero(), 1.48);
      return a.distance < b.distance ? a : b;
    };
    const BodyMesh made = meshBody(ringAndBall, boxOf(3), 0.25, 0.005);
    checkClosed(made.mesh);
    QCOMPARE(made.bodies, 1);
    QVERIFY(made.fit.deviation <= 0.005);
    QVERIFY(made.fit.filled > 0.005 && made.fit.filled < 0.25);
  }

  void sameBytes() {
    const auto first = meshBody(torus(2, 0.5), boxOf(3), 0.25, 0.02),
               second = meshBody(torus(2, 0.5), boxOf(3), 0.25, 0.02);
    QVERIFY(first.mesh.points == second.mesh.points && first.mesh.triangles == second.mesh.triangles);
  }

  void closedness() {
    const auto errorOf = [](const SurfaceMesh& mesh) -> QString {
      try {
        checkClosed(mesh);
      } catch (const pliant::base::InputError& error) {
        return error.problem().c_str();
      }
      return {};
    };
    SurfaceMesh tetrahedron;
    tetrahedron.points = (Eigen::Matrix3Xd(3, 4) << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1).finished();
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    QCOMPARE(errorOf(tetrahedron), QString());
    QVERIFY(std::abs(enclosedVolume(tetrahedron) - 1.0 / 6) < 1e-15);
    SurfaceMesh open = tetrahedron;
    open.triangles.pop_back();
    QVERIFY(errorOf(open).contains("open"));
    SurfaceMesh turned = tetrahedron;
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    QVERIFY(errorOf(turned).contains("same direction"));
    // Two tetrahedra that have one corner in common.
    SurfaceMesh pinched = tetrahedron;
    pinched.points.conservativeResize(3, 7);
    pinched.points.rightCols(3) = -tetrahedron.points.rightCols(3);
    for (const auto& [a, b, c] : tetrahedron.triangles)
      pinched.triangles.push_back({a ? a + 3 : 0, c ? c + 3 : 0, b ? b + 3 : 0});
    QVERIFY(errorOf(pinched).contains("touches itself at point 0"));
  }

  void nothingThere() {
    QVERIFY_THROWS_EXCEPTION(pliant::base::InputError, meshBody(balls({{{9, 9, 9}, 1}}), boxOf(1), 0.25, 0.01));
    QVERIFY_THROWS_EXCEPTION(pliant::base::InputError, meshBody(torus(5, 0.8), boxOf(6), 1e-3, 1e-4));
  }
};

QTEST_GUILESS_MAIN(TestImplicitSurface)
#include "test_implicit_surface.moc"
