#include <Eigen/Geometry>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/interlock/cell_equilibrium.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/linking_number.hpp"
#include "core/interlock/patch_equilibrium.hpp"
#include "core/interlock/swept_contact.hpp"
#include "core/math/parallel.hpp"
#include "tests/core/interlock/link_oracles.hpp"
#include "tests/core/interlock/torus_mesh.hpp"

using namespace pliant;
using namespace pliant::interlock;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Whether the segment from p to q crosses the triangle, by signed volumes.
bool crosses(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const auto volume = [](const Vector3d& u, const Vector3d& v, const Vector3d& w, const Vector3d& x) {
    return (v - u).cross(w - u).dot(x - u);
  };
  if ((volume(a, b, c, p) > 0) == (volume(a, b, c, q) > 0)) return false;
  const bool first = volume(p, q, a, b) > 0, second = volume(p, q, b, c) > 0, third = volume(p, q, c, a) > 0;
  return first == second && second == third;
}

using Triangles = std::vector<std::array<Vector3d, 3>>;

Triangles trianglesOf(const UnitCell& cell, const CellState& state, int element, const Vector3d& offset) {
  Triangles result;
  for (const DilatedPiece& piece : cell.shapes[cell.elements[element].shape].pieces) {
    const auto& set = std::get<SimplexSet>(piece.core);
    for (const auto& [a, b, c] : set.triangles) {
      const auto place = [&](int corner) -> Vector3d {
        return state.rotations[element] * set.corners.col(corner) + offset;
      };
      result.push_back({place(a), place(b), place(c)});
    }
  }
  return result;
}

bool cross(const Triangles& first, const Triangles& second) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : second)
    for (const Vector3d& corner : triangle) box.extend(corner);
  for (const auto& x : first) {
    Eigen::AlignedBox3d own;
    for (const Vector3d& corner : x) own.extend(corner);
    if (!own.intersects(box)) continue;
    for (const auto& y : second) {
      Eigen::AlignedBox3d other;
      for (const Vector3d& corner : y) other.extend(corner);
      if (!own.intersects(other)) continue;
      for (int i = 0; i < 3; ++i)
        if (crosses(x[i], x[(i + 1) % 3], y[0], y[1], y[2]) || crosses(y[i], y[(i + 1) % 3], x[0], x[1], x[2]))
          return true;
    }
  }
  return false;
}

/// By all pairs of triangles of all elements and images nearby, without any of the library's contact code.
bool surfacesMeet(const UnitCell& cell, const CellState& state) {
  const int count = static_cast<int>(cell.elements.size());
  const Eigen::Matrix2d lattice = stretchOf(state.strain) * cell.lattice;
  double reach = 0;
  for (const ElementShape& shape : cell.shapes)
    for (const DilatedPiece& piece : shape.pieces)
      reach = std::max(reach, std::get<SimplexSet>(piece.core).corners.colwise().norm().maxCoeff());
  const double area = std::abs(lattice.determinant());
  const int firstCount = static_cast<int>(std::ceil(4 * reach * lattice.col(1).norm() / area)) + 1;
  const int secondCount = static_cast<int>(std::ceil(4 * reach * lattice.col(0).norm() / area)) + 1;
  for (int a = 0; a < count; ++a)
    for (int b = a; b < count; ++b)
      for (int i = -firstCount; i <= firstCount; ++i)
        for (int j = -secondCount; j <= secondCount; ++j) {
          if (a == b && (i < 0 || (i == 0 && j <= 0))) continue;
          Vector3d offset = state.positions.col(a) - state.positions.col(b);
          offset.head<2>() -= lattice * Eigen::Vector2d(i, j);
          if (offset.norm() > 2 * reach) continue;
          if (cross(trianglesOf(cell, state, a, offset), trianglesOf(cell, state, b, Vector3d::Zero()))) return true;
        }
  return false;
}

geometry::SurfaceMesh boxMesh(const Vector3d& half) {
  geometry::SurfaceMesh mesh;
  mesh.points.resize(3, 8);
  for (int i = 0; i < 8; ++i)
    mesh.points.col(i) = half.cwiseProduct(Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Families with each ring's wire as a coarse mesh of radius 0.
UnitCell meshed(UnitCell cell) {
  for (ElementShape& shape : cell.shapes)
    for (DilatedPiece& piece : shape.pieces) {
      const auto& circle = std::get<ClosedCurve>(piece.core);
      geometry::SurfaceMesh mesh = torusMesh(circle.at(0).tangent.norm(), piece.radius, 14, 4);
      const Vector3d axis = circle.at(0).tangent.cross(circle.at(1.5).tangent);
      mesh.points =
          (Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix() * mesh.points).colwise() +
          circle.centre();
      piece = dilatedMesh(mesh, 0);
    }
  return cell;
}

}  // namespace

class TestSweptContact : public QObject {
  Q_OBJECT

 private slots:
  /// A box that falls on another is stopped before it is there, having used up most of the gap; images are met as the
  /// lattice shrinks; what moves away or aside is not stopped.
  void straightPaths() {
    UnitCell cell;
    cell.lattice = 10 * Eigen::Matrix2d::Identity();
    cell.shapes = {{"box", {dilatedMesh(boxMesh({1, 1, 1}), 0)}}};
    cell.elements = {{0, Vector3d::Zero(), Matrix3d::Identity()}, {0, Vector3d(0.3, 0.2, 2.5), Matrix3d::Identity()}};
    const CellContact contact(cell);
    const CellState rest = restState(cell);
    const auto fractionOf = [&](const Vector3d& path, const Vector3d& strain) {
      VectorXd motion = VectorXd::Zero(15);
      motion.segment<3>(6) = path;
      motion.tail<3>() = strain;
      return safeFraction(contact, rest, motion, VectorXd::Zero(2), 100);
    };
    const double met = fractionOf({0, 0, -5}, Vector3d::Zero());
    QVERIFY2(met >= 0.8 * 0.1 && met < 0.1, qPrintable(QString::number(met)));
    QCOMPARE(fractionOf({0, 0, -0.39}, Vector3d::Zero()), 1.0);
    QCOMPARE(fractionOf({0, 0, 50}, Vector3d::Zero()), 1.0);
    QCOMPARE(fractionOf({5, 5, 0}, Vector3d::Zero()), 1.0);
    // Neighbours along x are 8 apart, and 2 when the lattice has shrunk by 0.6.
    QCOMPARE(fractionOf(Vector3d::Zero(), {-0.6, 0, 0}), 1.0);
    const double images = fractionOf(Vector3d::Zero(), {-1, 0, 0});
    QVERIFY2(images >= 0.8 * 0.8 && images < 0.8, qPrintable(QString::number(images)));
  }

  /// A bar of half length 3 that turns about its middle meets the edge of a plate beside it at a known angle.
  void turningBar() {
    UnitCell cell;
    cell.lattice = 100 * Eigen::Matrix2d::Identity();
    cell.shapes = {
        {"bar", {dilatedMesh(boxMesh({3, 0.1, 0.1}), 0)}}, {"plate", {dilatedMesh(boxMesh({1, 0.5, 5}), 0)}}};
    cell.elements = {{0, Vector3d::Zero(), Matrix3d::Identity()}, {1, Vector3d(3, 2.5, 0), Matrix3d::Identity()}};
    const CellContact contact(cell);
    // The bar's upper side y = 0.1 reaches the plate's corner (2, 2): its distance from the middle is sqrt(8), and its
    // angle 45 degrees less that at which the side passes it.
    const double expected = 0.25 * std::numbers::pi - std::asin(0.1 / std::sqrt(8.0));
    for (const double angle : {0.9, 3.0, 6.0}) {
      VectorXd motion = VectorXd::Zero(15);
      motion[5] = angle;
      const double met = angle * safeFraction(contact, restState(cell), motion, VectorXd::Zero(2), 100);
      QVERIFY2(met < expected && met > 0.6 * expected, qPrintable(QString("%1 %2").arg(met).arg(expected)));
    }
    VectorXd away = VectorXd::Zero(15);
    away[5] = 0.7 * expected;
    QCOMPARE(safeFraction(contact, restState(cell), away, VectorXd::Zero(2), 100), 1.0);
  }

  /// Random motions of linked meshes, many times longer than their gaps, one after the other: no surfaces meet on any
  /// of the ways.
  void randomMotions() {
    constexpr int walks = 9, steps = 4, samples = 5;
    const std::vector<UnitCell> cells = {meshed(fourInOne()), meshed(ringNet()), meshed(threefold())};
    std::vector<int> met(walks), stopped(walks);
    pliant::math::parallelFor(walks, [&](int k) {
      std::mt19937 random(700 + k);
      std::normal_distribution<double> normal;
      const UnitCell& cell = cells[k % cells.size()];
      const CellContact contact(cell);
      CellState state = restState(cell);
      for (int step = 0; step < steps; ++step) {
        VectorXd motion(contact.coordinateCount());
        for (Eigen::Index i = 0; i < motion.size(); ++i) motion[i] = normal(random) * (i % 6 < 3 ? 2e-3 : 0.5);
        for (int i = 0; i < 3; ++i) motion[motion.size() - 3 + i] = 0.05 * normal(random);
        const double fraction = safeFraction(contact, state, motion, VectorXd::Zero(state.positions.cols()), 20e-3);
        stopped[k] += fraction < 1;
        if (!(fraction > 0)) met[k] = 1;
        for (int i = 1; i <= samples; ++i) met[k] |= surfacesMeet(cell, moved(state, motion, fraction * i / samples));
        state = moved(state, motion, fraction);
      }
    });
    for (int k = 0; k < walks; ++k) QVERIFY2(!met[k], qPrintable(QString("walk %1").arg(k)));
    QVERIFY(*std::min_element(stopped.begin(), stopped.end()) > 0);
  }

  /// On a paraboloid, where ways are curved, a patch of meshes is bent until it locks or folds.
  void bentPatch() {
    PatchOutline outline;
    outline.kind = PatchOutline::Kind::circle;
    outline.radius = 11e-3;
    const UnitCell patch = cutPatch(meshed(ringNet()), outline);
    EquilibriumOptions options;
    options.finalGap = 1e-2;
    options.maximumIterations = 100;
    const PatchSolver solver(patch, options);
    StrainDrive drive;
    drive.directions = drive.load = Vector3d(1, 0.4, 0.2).normalized();
    const CellEquilibrium rest = solver.bend(solver.perturbed(restState(patch), 0.1, 3), drive);
    QVERIFY(rest.state.strain.norm() > 10);
    QVERIFY(rest.message.find("link") == std::string::npos);
    for (int a = 0; a < static_cast<int>(patch.elements.size()); ++a)
      for (int b = 0; b < a; ++b)
        QVERIFY(!cross(trianglesOf(patch, rest.state, a, rest.state.positions.col(a)),
                       trianglesOf(patch, rest.state, b, rest.state.positions.col(b))));
  }

  /// Pulls far outside the limits of meshes: no surfaces meet in the end, and the circles within are linked as at rest
  /// by Gauss's integral.
  void randomPulls() {
    constexpr int pulls = 6;
    std::vector<QString> faults(pulls);
    std::vector<int> settled(pulls);
    pliant::math::parallelFor(pulls, [&](int k) {
      std::mt19937 random(40 + k);
      std::normal_distribution<double> normal;
      const UnitCell curves = k % 2 ? ringNet() : fourInOne(), cell = meshed(curves);
      EquilibriumOptions options;
      options.finalGap = 1e-2;
      options.maximumIterations = 150;
      const CellSolver solver(cell, options);
      StrainDrive drive;
      drive.load = Vector3d(normal(random), normal(random), normal(random));
      for (int element = 1; element < static_cast<int>(cell.elements.size()) && k % 3 == 0; ++element)
        drive.pulls.push_back({element, 300 * Vector3d(normal(random), normal(random), normal(random)), 0, {}});
      const CellState start = solver.perturbed(restState(cell), 0.05, static_cast<unsigned>(k));
      const CellEquilibrium rest = solver.solve(start, drive);
      settled[k] = rest.converged();
      if (surfacesMeet(cell, rest.state)) faults[k] = "surfaces meet";
      if (rest.message.find("link") != std::string::npos) faults[k] = rest.message.c_str();
      for (const Link& link : curves.links) {
        const auto curveOf = [&](int element, int piece) {
          return std::get<ClosedCurve>(curves.shapes[curves.elements[element].shape].pieces[piece].core)
              .rotated(rest.state.rotations[element]);
        };
        const double integral = gaussIntegral(curveOf(link.a, link.pieceA), curveOf(link.b, link.pieceB),
                                              solver.contact().offsetOf(rest.state, link.a, link.b, link.shift), 200);
        if (std::abs(integral - link.number) > 0.1) faults[k] = QString("linked %1 times").arg(integral);
      }
    });
    for (int k = 0; k < pulls; ++k)
      QVERIFY2(faults[k].isEmpty(), qPrintable(QString("pull %1: %2").arg(k).arg(faults[k])));
    qInfo("%d of %d pulls settled", static_cast<int>(std::count(settled.begin(), settled.end(), 1)), pulls);
  }
};

QTEST_GUILESS_MAIN(TestSweptContact)
#include "test_swept_contact.moc"
