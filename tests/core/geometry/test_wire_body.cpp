#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/thick_surface.hpp"
#include "core/geometry/wire_body.hpp"

using namespace pliant::geometry;
using Eigen::Vector3d;
using std::numbers::pi;

namespace {

constexpr double tolerance = 0.01;

int genusOf(const SurfaceMesh& mesh) {
  return 1 - (static_cast<int>(mesh.points.cols()) - static_cast<int>(mesh.triangles.size() / 2)) / 2;
}

double areaOf(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * (mesh.points.col(b) - mesh.points.col(a)).cross(mesh.points.col(c) - mesh.points.col(a)).norm();
  return sum;
}

BodyMesh made(std::vector<WirePiece> pieces, const std::vector<BallSocket>& sockets = {}) {
  findStrands(pieces);
  const pliant::base::ExecutionContext context;
  return *meshWires(pieces, sockets, tolerance, context);
}

WirePiece wire(const Vector3d& from, const Vector3d& to, double radius = 0.5) { return {from, to, radius}; }

double distanceFrom(const WirePiece& piece, const Vector3d& place) {
  const Vector3d along = piece.to - piece.from;
  const double at = std::clamp((place - piece.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (place - piece.from - at * along).norm() - piece.rounding;
}

}  // namespace

class TestWireBody : public QObject {
  Q_OBJECT

 private slots:
  /// The volume is within the tolerance times the area of that of a cylinder with two half balls.
  void straightWire() {
    const double length = 6, radius = 0.5;
    const BodyMesh body = made({wire({1, 2, 3}, Vector3d(1, 2, 3) + length * Vector3d(0.48, 0.6, 0.64), radius)});
    checkSolid(body.mesh);
    QCOMPARE(body.bodies, 1);
    QCOMPARE(genusOf(body.mesh), 0);
    const double volume = pi * radius * radius * (length + 4.0 / 3 * radius);
    const double area = 2 * pi * radius * (length + 2 * radius);
    QVERIFY(std::abs(enclosedVolume(body.mesh) - volume) < tolerance * area);
    QVERIFY(std::abs(areaOf(body.mesh) - area) < 2 * tolerance / radius * area);
  }

  /// The same wire in three pieces has no trace of where they meet.
  void piecesOfOneStrand() {
    const Vector3d a(0, 0, 0), b(2, 0, 0), c(3, 0, 0), d(6, 0, 0);
    const BodyMesh body = made({wire(a, b), wire(c, b), wire(c, d)});
    const WirePiece whole = wire(a, d);
    for (Eigen::Index i = 0; i < body.mesh.points.cols(); ++i)
      QVERIFY(std::abs(distanceFrom(whole, body.mesh.points.col(i))) < 0.011 * tolerance);
  }

  /// A bar of a rectangular section with round edges: a core box and all within the rounding of it (Steiner's formula).
  void flatBar() {
    const double length = 4, a = 0.9, b = 0.2, r = 0.2;  // half sizes of the core
    const BodyMesh body = made({{{0, 0, 0}, {0, 0, length}, r, a, b, Vector3d(0.6, 0.8, 0)}});
    checkSolid(body.mesh);
    QCOMPARE(genusOf(body.mesh), 0);
    const double box = 8 * a * b * length / 2, sides = 2 * (4 * a * b + 2 * a * length + 2 * b * length);
    const double edges = 4 * (2 * a + 2 * b + length);
    const double volume = box + sides * r + edges * pi * r * r / 4 + 4 * pi * r * r * r / 3;
    const double area = sides + edges * pi * r / 2 + 4 * pi * r * r;
    QVERIFY(std::abs(enclosedVolume(body.mesh) - volume) < tolerance * area);
    // It is wide where it is meant to be.
    const Eigen::RowVectorXd across = Vector3d(0.6, 0.8, 0).transpose() * body.mesh.points;
    QVERIFY(std::abs(across.maxCoeff() - a - r) < 2 * tolerance);
    const Eigen::RowVectorXd through = Vector3d(-0.8, 0.6, 0).transpose() * body.mesh.points;
    QVERIFY(std::abs(through.maxCoeff() - b - r) < 2 * tolerance);
  }

  /// A triangle of wire with a line from one corner to the middle of a side has two openings. Nowhere is it thinner
  /// than its pieces, and nowhere does a fillet add more than k/4 for each strand beyond the first.
  void network() {
    const Vector3d a(0, 0, 0), b(6, 0, 0), c(0, 6, 1), d(3, 3, 0.5);
    const std::vector<WirePiece> pieces{wire(a, b), wire(b, d), wire(d, c), wire(c, a), wire(a, d)};
    const BodyMesh body = made(pieces);
    checkSolid(body.mesh);
    QCOMPARE(body.bodies, 1);
    QCOMPARE(genusOf(body.mesh), 2);
    for (Eigen::Index i = 0; i < body.mesh.points.cols(); ++i) {
      double nearest = 1e300;
      for (const WirePiece& piece : pieces) nearest = std::min(nearest, distanceFrom(piece, body.mesh.points.col(i)));
      QVERIFY(nearest > -tolerance && nearest < 3 * 0.25 * 0.5 + tolerance);
    }
  }

  /// Walls that part at sharp angles: the mesh does not cut itself, and holds what the wires hold.
  void acuteAngles() {
    for (const double degrees : {8.0, 13.0, 21.0, 34.0}) {
      const double angle = degrees * pi / 180;
      const Vector3d tip(0, 0, 0), straight(7, 0, 0), bent = 7 * Vector3d(std::cos(angle), std::sin(angle), 0.1);
      const std::vector<WirePiece> pieces{wire(tip, straight), wire(tip, bent), wire(tip, {4, -0.6, 1.5})};
      const BodyMesh body = made(pieces);
      checkSolid(body.mesh);
      QCOMPARE(genusOf(body.mesh), 0);
      for (Eigen::Index i = 0; i < body.mesh.points.cols(); ++i)
        for (const WirePiece& piece : pieces) QVERIFY(distanceFrom(piece, body.mesh.points.col(i)) > -5 * tolerance);
    }
  }

  /// A socket alone, beside a wire: the part of a shell that a cone cuts out, and the half of a torus at its rim
  /// (Pappus' theorem).
  void socketAlone() {
    const double radius = 2, wall = 0.6, middle = radius + 0.5 * wall, length = 3;
    const Vector3d opening = Vector3d(1, 2, 2) / 3;
    const BodyMesh body = made({wire({6, 0, 0}, {6, 0, length})}, {{{0, 0, 0}, radius, wall, opening}});
    checkSolid(body.mesh);
    QCOMPARE(body.bodies, 2);
    QCOMPARE(genusOf(body.mesh), -1);  // two balls
    const double outer = radius + wall, covered = 2 * pi * (1 + std::cos(socketOpening));
    const double rim = middle * std::sin(socketOpening) - 2 * wall / (3 * pi) * std::cos(socketOpening);
    const double cup = covered / 3 * (std::pow(outer, 3) - std::pow(radius, 3)) + 2 * pi * rim * pi * wall * wall / 8;
    const double volume = cup + pi * 0.25 * (length + 4.0 / 3 * 0.5);
    QVERIFY(std::abs(enclosedVolume(body.mesh) - volume) < tolerance * areaOf(body.mesh));
  }

  /// A wire through a ball's place: cut away inside, held together by the socket, with room for the ball.
  void socketOnWire() {
    const double radius = 1.5, wall = 0.6;
    const std::vector<WirePiece> pieces{wire({-5, 0, 0}, {0, 0, 0}), wire({0, 0, 0}, {5, 0, 0})};
    const Vector3d opening = openDirection(pieces, Vector3d::Zero(), radius);
    QVERIFY(std::abs(opening[0]) < 1e-12);
    const BodyMesh body = made(pieces, {{Vector3d::Zero(), radius, wall, opening}});
    checkSolid(body.mesh);
    QCOMPARE(body.bodies, 1);
    QCOMPARE(genusOf(body.mesh), 0);
    double nearest = 1e300;
    for (Eigen::Index i = 0; i < body.mesh.points.cols(); ++i)
      nearest = std::min(nearest, body.mesh.points.col(i).norm());
    QVERIFY(std::abs(nearest - radius) < tolerance);
  }

  void openings() {
    const Vector3d centre(1, 2, 3);
    const auto towards = [&](const Vector3d& direction) { return wire(centre, centre + 5 * direction); };
    const Vector3d single = openDirection({towards(Vector3d(0.6, 0.8, 0))}, centre, 1);
    QVERIFY((single - Vector3d(-0.6, -0.8, 0)).norm() < 1e-12);
    const Vector3d plane =
        openDirection({towards({1, 0, 0}), towards({0, 0, 1}), towards(Vector3d(-0.6, 0, -0.8))}, centre, 1);
    QVERIFY(std::abs(std::abs(plane[1]) - 1) < 1e-12);
    QVERIFY((openDirection({}, centre, 1) - Vector3d::UnitZ()).norm() < 1e-15);
  }

  void refusedOrCancelled() {
    pliant::base::ExecutionContext context;
    QVERIFY_THROWS_EXCEPTION(pliant::base::InputError, meshWires({}, {}, 0.1, context));
    QVERIFY_THROWS_EXCEPTION(pliant::base::InputError, meshWires({wire({0, 0, 0}, {1, 0, 0}, 0)}, {}, 0.1, context));
    context.requestCancel();
    QVERIFY(!meshWires({wire({0, 0, 0}, {1, 0, 0})}, {}, 0.1, context));
  }
};

QTEST_GUILESS_MAIN(TestWireBody)
#include "test_wire_body.moc"
