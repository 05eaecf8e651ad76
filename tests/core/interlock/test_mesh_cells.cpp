#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/interlock/cell_inspection.hpp"
#include "core/interlock/deformation_test.hpp"
#include "core/interlock/element_body.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/handle_cycles.hpp"
#include "core/interlock/linking_number.hpp"
#include "core/interlock/overlapping_bodies.hpp"
#include "core/interlock/patch_equilibrium.hpp"
#include "tests/core/interlock/link_oracles.hpp"
#include "tests/core/interlock/torus_mesh.hpp"

using namespace pliant;
using namespace pliant::interlock;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

namespace {

constexpr double ringRadius = 5e-3, wireRadius = 0.8e-3;

/// How far the surface of the mesh is from the torus at most, inwards or outwards.
double torusError(int around, int across) {
  return (ringRadius + wireRadius) * (1 - std::cos(std::numbers::pi / around)) +
         wireRadius * (1 - std::cos(std::numbers::pi / across));
}

/// Along x, flat rings and upright ones in turn, `shape` for all of them.
UnitCell chainOf(const ElementShape& shape) {
  UnitCell cell;
  cell.name = "chain";
  cell.shapes = {shape};
  cell.lattice = Eigen::Vector2d(4 * (ringRadius - 1.3 * wireRadius), 0.1).asDiagonal();
  const Eigen::Matrix3d upright = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()).toRotationMatrix();
  cell.elements = {
      {0, Vector3d::Zero(), Eigen::Matrix3d::Identity()}, {0, Vector3d(0.5 * cell.lattice(0, 0), 0, 0), upright}};
  return cell;
}

int linkingOf(const Cycle& cycle, const Matrix3Xd& probe) {
  int sum = 0;
  for (const Matrix3Xd& polygon : cycle) sum += linkingNumber(polygon, probe).value();
  return sum;
}

geometry::SurfaceMesh tetrahedron(double size) {
  geometry::SurfaceMesh mesh;
  mesh.points.resize(3, 4);
  mesh.points << 0, size, 0, 0, 0, 0, size, 0, 0, 0, 0, size;
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

QString faultOf(const UnitCell& cell) {
  try {
    checkCell(cell);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

class TestMeshCells : public QObject {
  Q_OBJECT

 private slots:
  /// A ball has no handle. That of a ring runs once around, counterclockwise, however the ring is placed.
  void handlesOfSimpleBodies() {
    QVERIFY(handleCycles(tetrahedron(1)).empty());
    for (const int across : {3, 4, 9})
      for (const Vector3d& axis : {Vector3d(0, 0, 1), Vector3d(0.2, 1, 0.1), Vector3d(-1, 0.3, 0.5)}) {
        geometry::SurfaceMesh torus = torusMesh(2, 0.7, 7, across);
        const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis);
        torus.points = turn.toRotationMatrix() * torus.points;
        const auto cycles = handleCycles(torus);
        QCOMPARE(cycles.size(), std::size_t{1});
        // A loop through the hole along the axis, and back far outside.
        const Vector3d up = axis.normalized(), aside = 10 * up.unitOrthogonal();
        Matrix3Xd probe(3, 4);
        probe << -5 * up, 5 * up, 5 * up + aside, -5 * up + aside;
        Eigen::Index largest = 0;
        axis.cwiseAbs().maxCoeff(&largest);
        QCOMPARE(linkingOf(cycles[0], probe), axis[largest] > 0 ? 1 : -1);
      }
  }

  /// Three rings that are one body: loops through one of them each are told apart by the cycles, and no combination of
  /// cycles is linked with less: the matrix of their linking numbers is unimodular.
  void handlesOfFusedRings() {
    const ElementShape shape = threefold().shapes[0];
    const geometry::SurfaceMesh mesh = ElementBody(shape).mesh(0.05e-3).mesh;
    const auto cycles = handleCycles(mesh);
    QCOMPARE(cycles.size(), std::size_t{3});
    Eigen::Matrix3d numbers;
    for (int k = 0; k < 3; ++k) {
      const ClosedCurve ring = std::get<ClosedCurve>(shape.pieces[k].core);
      const Vector3d axis = ring.at(0).tangent.cross(ring.at(0).second).normalized(), out = ring.centre().normalized();
      Matrix3Xd probe(3, 4);
      probe << ring.centre() - 0.03 * axis, ring.centre() + 0.03 * axis, ring.centre() + 0.03 * axis + 0.05 * out,
          ring.centre() - 0.03 * axis + 0.05 * out;
      for (int i = 0; i < 3; ++i) numbers(i, k) = linkingOf(cycles[i], probe);
    }
    QVERIFY(std::abs(std::abs(numbers.determinant()) - 1) < 1e-12);
  }

  /// Rings as meshes are linked as their circles are; the cell is refused without its links, and as one that is not
  /// linked.
  void linksOfMeshes() {
    for (UnitCell cell : {fourInOne(), ringNet()}) {
      for (ElementShape& shape : cell.shapes) {
        const auto& circle = std::get<ClosedCurve>(shape.pieces[0].core);
        const double radius = circle.at(0).tangent.norm();
        // The families' rings are about z, or not: their own axis tells.
        const Vector3d axis = circle.at(0).tangent.cross(circle.at(1.5).tangent);
        geometry::SurfaceMesh mesh = torusMesh(radius, shape.pieces[0].radius, 24, 8);
        mesh.points = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix() * mesh.points;
        shape.pieces = {dilatedMesh(mesh, 0)};
      }
      QCOMPARE(faultOf(cell), QString());
      UnitCell undeclared = cell;
      undeclared.links.pop_back();
      QVERIFY(faultOf(undeclared).contains("but this is not declared"));
      UnitCell apart = cell;
      apart.lattice *= 5;
      for (InterlockingElement& element : apart.elements) element.position *= 5;
      QVERIFY(faultOf(apart).contains("are linked 0 times at rest, but declared are"));
    }
  }

  /// A mesh within another, or through another, or around a curve, is no gap.
  void bodiesWithinEachOther() {
    UnitCell cell;
    cell.lattice = 100 * Eigen::Matrix2d::Identity();
    cell.shapes = {{"big", {dilatedMesh(tetrahedron(10), 0)}},
                   {"small", {dilatedMesh(tetrahedron(1), 0)}},
                   {"ring", {wire(ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), 0.5), 0.1)}}};
    for (const int other : {1, 2})
      for (const bool swapped : {false, true}) {
        const auto faultAt = [&](const Vector3d& place) {
          cell.elements = {
              {0, Vector3d::Zero(), Eigen::Matrix3d::Identity()}, {other, place, Eigen::Matrix3d::Identity()}};
          if (swapped) std::swap(cell.elements[0], cell.elements[1]);
          return faultOf(cell);
        };
        QCOMPARE(faultAt({20, 0, 0}), QString());
        QCOMPARE(faultAt({5, 5, 5}), QString());
        QVERIFY2(faultAt({2, 2, 2}).contains("lement 0 and element 1 moved by (0, 0) lattice vectors overlap"),
                 qPrintable(faultAt({2, 2, 2})));
        QVERIFY(faultAt({2, 2, -0.05}).contains("overlap"));
      }
  }

  /// An editor's inspection finds what checkCell does, and where surfaces are nearest.
  void inspection() {
    UnitCell cell;
    cell.lattice = 100 * Eigen::Matrix2d::Identity();
    cell.shapes = {{"body", {dilatedMesh(tetrahedron(1), 0)}}};
    cell.elements = {{0, Vector3d::Zero(), Eigen::Matrix3d::Identity()},
                     {0, Vector3d(0.1, 0.1, -1.25), Eigen::Matrix3d::Identity()}};
    const CellInspection apart = inspectCell(cell);
    QCOMPARE(QString(apart.fault.c_str()), QString());
    QVERIFY(apart.nearest && std::abs(apart.nearest->gap - 0.25) < 1e-12);
    QVERIFY((apart.nearest->place - Vector3d(0.1, 0.1, -0.125)).norm() < 1e-12);
    cell.elements[1].position.z() = -0.9;
    QCOMPARE(QString(inspectCell(cell).fault.c_str()), QString("Elements 1 and 2 overlap."));
  }

  /// A dilated mesh is solid, as the formula of Steiner (1840) has it: V + A r + M r² + 4/3 π r³, with M = π times the
  /// sum of a box's three lengths.
  void dilatedMeshIsSolid() {
    geometry::SurfaceMesh box;
    box.points.resize(3, 8);
    for (int i = 0; i < 8; ++i) box.points.col(i) = Vector3d(i & 1 ? 3 : 0, i & 2 ? 2 : 0, i & 4 ? 4 : 0);
    box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    const double r = 0.5, exact = 24 + 52 * r + std::numbers::pi * 9 * r * r + 4.0 / 3 * std::numbers::pi * r * r * r;
    const ElementShape shape{"box", {dilatedMesh(box, r)}};
    checkShape(shape);
    const ElementBody body(shape);
    QVERIFY(std::abs(body.at({1.5, 0.4, 1}).distance + 0.9) < 1e-12);
    QVERIFY(std::abs(body.at({1.5, -0.7, 1}).distance - 0.2) < 1e-12);
    const double volume = geometry::enclosedVolume(body.mesh(0.01).mesh);
    QVERIFY2(volume < exact && volume > 0.99 * exact, qPrintable(QString("%1 of %2").arg(volume).arg(exact)));
  }

  /// Rings with n sections of m corners, a flat side innermost, whose holes are R - r cos(π/m) at their corners: at
  /// most four of that is the chain's length, since the flat sides of neighbours are nowhere farther from their
  /// centres. Each flat side may lie in the groove at a corner of the other ring's hole, h tan(π/n) from its bottom
  /// with h = r sin(π/m): so far they can be pulled at least. Both bounds converge to 4 (R - r), that of circles, with
  /// the square of the size of the triangles.
  void chainOfMeshRings() {
    const double circles = 4 * (ringRadius - wireRadius);
    for (const int across : {8, 16, 32}) {
      const int around = 3 * across;
      const double half = std::numbers::pi / across;
      ElementShape ring{
          "ring", {dilatedMesh(torusMesh(ringRadius, wireRadius, around, across, 1.2 / around, half), 0)}};
      UnitCell cell = chainOf(ring);
      cell.links = LinkFinder(CellContact(cell)).linksAt(restState(cell)).value();
      QCOMPARE(cell.links.size(), std::size_t{2});
      QCOMPARE(faultOf(cell), QString());
      const CellSolver solver(cell);
      LimitOptions held;
      held.lateral = Lateral::held;
      const auto limit = directionLimit(solver, 0, false, held);
      QVERIFY2(limit.equilibrium.converged(), limit.equilibrium.message.c_str());
      QCOMPARE(limit.equilibrium.kind, RestKind::locked);
      const double error = (1 + limit.strain) * cell.lattice(0, 0) - circles;
      const double most = 4 * wireRadius * (1 - std::cos(half));
      const double least = most - 4 * wireRadius * std::sin(half) * std::tan(std::numbers::pi / around);
      qInfo("%d x %d: %.3f um longer than circles, within %.3f and %.3f, %d iterations", around, across, 1e6 * error,
            1e6 * least, 1e6 * most, limit.equilibrium.iterations);
      QVERIFY(error > least - 4e-4 * cell.smallestRadius() && error < most);
    }
  }

  /// A ring as a chain of thin rods, whose contact length is far above their radius, against the circle: the corners
  /// lie on it, so that the limit is below that of circles by the sagitta of four rods at most.
  void thinRods() {
    constexpr double thin = 0.02e-3;
    constexpr int rods = 96;
    Matrix3Xd corners(3, rods);
    for (int i = 0; i < rods; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.3) / rods;
      corners.col(i) = ringRadius * Vector3d(std::cos(angle), std::sin(angle), 0);
    }
    ElementShape ring{"ring", {closedChain(corners, thin)}, 0.5e-3};
    UnitCell cell = chainOf(ring);
    cell.links = LinkFinder(CellContact(cell)).linksAt(restState(cell)).value();
    QCOMPARE(faultOf(cell), QString());
    QVERIFY(CellContact(cell).hasThinPieces());
    const CellSolver solver(cell);
    LimitOptions held;
    held.lateral = Lateral::held;
    const auto limit = directionLimit(solver, 0, false, held);
    QVERIFY2(limit.equilibrium.converged(), limit.equilibrium.message.c_str());
    const double length = (1 + limit.strain) * cell.lattice(0, 0), exact = 4 * (ringRadius - thin);
    const double sagitta = ringRadius * (1 - std::cos(std::numbers::pi / rods));
    QVERIFY2(length < exact && length > exact - 4 * sagitta - 4 * limit.equilibrium.meanGap,
             qPrintable(QString("%1 of %2").arg(length).arg(exact)));
  }

  /// A ring that hangs in a clamped one, both meshes: 2 (R - r) below it, within the meshes' error.
  void hangingRing() {
    constexpr int around = 48, across = 24;
    UnitCell patch = chainOf({"ring", {dilatedMesh(torusMesh(ringRadius, wireRadius, around, across), 0)}});
    patch.lattice.setZero();
    const PatchSolver solver(patch);
    QCOMPARE(solver.links().size(), std::size_t{1});
    PatchLoads loads;
    loads.clamped = {0};
    loads.forces = {{1, {1, 0, 0}, Vector3d::Zero()}};
    const CellEquilibrium rest = solver.solve(restState(patch), loads);
    QVERIFY2(rest.converged(), rest.message.c_str());
    QCOMPARE(rest.kind, RestKind::locked);
    const double distance = rest.state.positions(0, 1) - rest.state.positions(0, 0);
    QVERIFY2(std::abs(distance - 2 * (ringRadius - wireRadius)) < 2 * torusError(around, across),
             qPrintable(QString::number(distance)));
  }
};

QTEST_GUILESS_MAIN(TestMeshCells)
#include "test_mesh_cells.moc"
