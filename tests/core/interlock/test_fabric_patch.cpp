#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/interlock/element_body.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/fabric_patch.hpp"

using namespace pliant::interlock;
using Eigen::Vector3d;
using std::numbers::pi;

namespace {

/// From a place to a circle, in closed form.
double distanceToCircle(const Vector3d& place, const ClosedCurve& circle) {
  const Vector3d first = circle.harmonics()[0].cosine, second = circle.harmonics()[0].sine;
  const Vector3d normal = first.cross(second).normalized(), arm = place - circle.centre();
  const double height = arm.dot(normal), across = (arm - height * normal).norm();
  return std::hypot(across - first.norm(), height);
}

/// To all pieces of a shape of circles, rods and plates, less their radii; plates and rods by samples of `step`.
double distanceBySamples(const Vector3d& place, const ElementShape& shape) {
  double least = 1e300;
  for (const DilatedPiece& piece : shape.pieces) {
    if (const auto* curve = std::get_if<ClosedCurve>(&piece.core)) {
      least = std::min(least, distanceToCircle(place, *curve) - piece.radius);
      continue;
    }
    const SimplexSet& set = std::get<SimplexSet>(piece.core);
    constexpr int n = 80;
    for (const auto& [a, b] : set.segments)
      for (int i = 0; i <= n; ++i)
        least = std::min(
            least, (place - (set.corners.col(a) * i + set.corners.col(b) * (n - i)) / n).norm() - piece.radius);
    for (const auto& [a, b, c] : set.triangles)
      for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j)
          least = std::min(
              least, (place - (set.corners.col(a) * i + set.corners.col(b) * j + set.corners.col(c) * (n - i - j)) / n)
                             .norm() -
                         piece.radius);
  }
  return least;
}

/// Rings, rods and plates at random; for `aligned` ones at whole millimetres along the axes, where surfaces touch and
/// coincide.
ElementShape randomShape(unsigned seed, bool aligned) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto vector = [&] { return Vector3d(coordinate(random), coordinate(random), coordinate(random)); };
  const auto place = [&]() -> Vector3d {
    const Vector3d any = 2.5e-3 * vector();
    return aligned ? Vector3d((any / 1e-3).array().round() * 1e-3) : any;
  };
  // The first holds all others together.
  ElementShape shape{"random", {wire(ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), 3e-3), 1.5e-3)}};
  for (int i = 0; i < 3; ++i) {
    const double radius = aligned ? 0.5e-3 : 0.6e-3 + 0.2e-3 * coordinate(random);
    const Vector3d from = place(), to = from + Vector3d(2e-3, aligned ? 0 : 1e-3, 0);
    const Vector3d axis = aligned ? Vector3d(Vector3d::Unit(random() % 3)) : vector();
    switch (random() % 3) {
      case 0: shape.pieces.push_back(wire(ClosedCurve::circle(from, axis, 3e-3), radius)); break;
      case 1: shape.pieces.push_back(capsule(from, to, radius)); break;
      case 2:
        shape.pieces.push_back(
            roundedPolygon((Eigen::Matrix3Xd(3, 3) << from, to, from + Vector3d(0, 2e-3, 0)).finished(), radius));
    }
  }
  return shape;
}

QString errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const pliant::base::InputError& error) {
    return error.problem().c_str();
  }
  return {};
}

}  // namespace

class TestFabricPatch : public QObject {
  Q_OBJECT

 private slots:
  /// The distance of a body against closed forms and samples.
  void distances() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(-11e-3, 11e-3);
    for (const UnitCell& cell : {fourInOne(), threefold(), squareRosette(), scaleMail()}) {
      const ElementBody body(cell.shapes[0]);
      // Samples of plates are up to 0.09 mm off, which counts little outside of their radius of 0.8 mm.
      const double sampling = cell.name == "scale mail" ? 1e-5 : 1e-12;
      for (int k = 0; k < (cell.name == "scale mail" ? 60 : 1000); ++k) {
        const Vector3d place(coordinate(random), coordinate(random), 0.7 * coordinate(random));
        const auto [distance, nearest] = body.at(place);
        if (sampling > 1e-6 && distance < 0) continue;
        QVERIFY(std::abs(distance - distanceBySamples(place, cell.shapes[0])) < sampling);
        if (distance > 0) {
          QVERIFY(std::abs((place - nearest).norm() - distance) < 1e-12);
          QVERIFY(std::abs(body.at(nearest).distance) < 1e-12);
        }
      }
    }
  }

  void meshOfARing() {
    const double tolerance = 2e-5;
    const auto made = ElementBody(fourInOne().shapes[0]).mesh(tolerance);
    pliant::geometry::checkClosed(made.mesh);
    const double volume = 2 * pi * pi * 5e-3 * 0.8e-3 * 0.8e-3, area = 4 * pi * pi * 5e-3 * 0.8e-3;
    QVERIFY(std::abs(enclosedVolume(made.mesh) - volume) < tolerance * area);
    QCOMPARE(made.mesh.points.cols(), Eigen::Index(made.mesh.triangles.size() / 2));  // of genus 1
  }

  /// Fused rings are one body, whose volume is that of the union by random places.
  void meshOfFusedRings() {
    const ElementShape shape = threefold().shapes[0];
    const double tolerance = 4e-5;
    const auto made = ElementBody(shape).mesh(tolerance);
    QCOMPARE(made.bodies, 1);
    std::mt19937 random(11);
    const Eigen::Vector3d half(11.2e-3, 11.2e-3, 4.8e-3);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    constexpr int count = 1'000'000;
    int inside = 0;
    for (int k = 0; k < count; ++k) {
      const Vector3d place = half.cwiseProduct(Vector3d(coordinate(random), coordinate(random), coordinate(random)));
      inside += distanceBySamples(place, shape) < 0;
    }
    const double share = static_cast<double>(inside) / count, box = 8 * half.prod();
    const double volume = share * box, deviation = box * std::sqrt(share * (1 - share) / count);
    double area = 0;
    for (const DilatedPiece& piece : shape.pieces) area += 4 * pi * pi * 4.8e-3 * piece.radius;
    // Four standard deviations, and the tolerance all over the surface.
    QVERIFY2(std::abs(enclosedVolume(made.mesh) - volume) < 4 * deviation + tolerance * area,
             qPrintable(QString("%1 against %2").arg(enclosedVolume(made.mesh)).arg(volume)));
  }

  /// Whatever runs into whatever: the mesh is closed and manifold, also after its coordinates were rounded for a file.
  void randomShapes() {
    int made = 0;
    for (unsigned seed = 0; seed < 8; ++seed) {
      const ElementShape shape = randomShape(seed, seed % 2 == 0);
      const QString error = errorOf([&] {
        const auto body = ElementBody(shape).mesh(6e-5);
        pliant::geometry::SurfaceMesh rounded = body.mesh;
        rounded.points = (1e3 * rounded.points).cast<float>().cast<double>();
        rounded = weldMesh(rounded, 0);
        checkClosed(rounded);
        if (!(enclosedVolume(rounded) > 0)) throw pliant::base::InputError("", "the volume is not above 0");
        if (body.fit.deviation > 6e-5) throw pliant::base::InputError("", "chords are too far off");
        ++made;
      });
      QVERIFY2(error.isEmpty() || error.contains("falls apart"), qPrintable(QString("%1: %2").arg(seed).arg(error)));
    }
    QVERIFY(made >= 4);
  }

  void piecesApart() {
    ElementShape shape = fourInOne().shapes[0];
    shape.pieces.push_back(wire(ClosedCurve::circle({20e-3, 0, 0}, Vector3d::UnitZ(), 5e-3), 0.8e-3));
    QVERIFY(errorOf([&] { ElementBody(shape).mesh(4e-5); }).contains("falls apart into 2 bodies"));
  }

  /// Elements inside an outline, against trying all that could be.
  void outlines() {
    const UnitCell cell = threefold();
    CellState state = restState(cell);
    state.strain = {0.02, -0.03, 0.04};
    const auto circle = patchInside(cell, state, circleOutline(0.1));
    const auto rectangle = patchInside(cell, state, rectangleOutline(0.12, 0.05));
    std::size_t inCircle = 0, inRectangle = 0;
    for (int i = -30; i <= 30; ++i)
      for (int j = -30; j <= 30; ++j) {
        const Vector3d place = placeOf(cell, state, {0, {i, j}});
        inCircle += place.norm() < 0.05;
        inRectangle += std::abs(place[0]) < 0.06 && std::abs(place[1]) < 0.025;
      }
    QCOMPARE(circle.elements.size(), inCircle);
    QCOMPARE(rectangle.elements.size() + rectangle.leftOut, inRectangle);
    QCOMPARE(patchOfCells(supercell(fourInOne(), 2, 1), 3, 4).elements.size(), std::size_t(48));
  }

  /// Of two squares that a bridge too thin for any element joins, the larger remains.
  void largestGroup() {
    const UnitCell cell = ringNet();  // 12 mm
    Eigen::Matrix2Xd outline(2, 12);
    outline << -100, -20, -20, 20, 20, 80, 80, 20, 20, -20, -20, -100,  //
        -40, -40, -4, -4, -30, -30, 30, 30, -3, -3, 40, 40;
    const FabricPatch patch = patchInside(cell, restState(cell), 1e-3 * outline);
    QVERIFY(patch.leftOut > 10);
    double least = 1, most = -1;
    for (const PatchElement& element : patch.elements) {
      const double x = placeOf(cell, restState(cell), element)[0];
      least = std::min(least, x), most = std::max(most, x);
    }
    QVERIFY(most < 0);  // the box's middle is at x = -10 mm
    QVERIFY(least < -80e-3);
  }

  void clearances() {
    QVERIFY(std::abs(clearance(fourInOne(), restState(fourInOne())) - 0.6e-3) < 1e-9);
    // Rings R = 4 at right angles, centres 6 apart: the nearest places are 2 from one another.
    QVERIFY(std::abs(clearance(ringNet(), restState(ringNet())) - (2 - 2 * 0.6) * 1e-3) < 1e-9);
  }

  void badOutlines() {
    const UnitCell cell = ringNet();
    const auto inside = [&](const Eigen::Matrix2Xd& polygon) {
      return errorOf([&] { patchInside(cell, restState(cell), polygon); });
    };
    QVERIFY(inside(Eigen::Matrix2Xd::Random(2, 2)).contains("three corners"));
    QVERIFY(inside(Eigen::Matrix2Xd::Zero(2, 3)).contains("no area"));
    QVERIFY(inside(Eigen::Matrix2Xd::Constant(2, 3, NAN)).contains("not finite"));
    QVERIFY(inside(rectangleOutline(1e3, 1e3)).contains("more than a million"));
    QVERIFY(
        inside((Eigen::Matrix2Xd(2, 4) << 0, 1e-3, 1e-3, 9e-4, 0, 0, 1e-3, 1e-4).finished()).contains("no element"));
    QVERIFY(errorOf([&] { patchOfCells(cell, 0, 3); }).contains("at least one cell"));
    QVERIFY(errorOf([&] { patchOfCells(cell, 1000, 1000); }).contains("more than a million"));
  }
};

QTEST_GUILESS_MAIN(TestFabricPatch)
#include "test_fabric_patch.moc"
