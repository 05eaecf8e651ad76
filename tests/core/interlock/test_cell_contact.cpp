#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>
#include <random>

#include "core/geometry/simplex_distance.hpp"
#include "core/interlock/cell_contact.hpp"
#include "core/interlock/element_families.hpp"
#include "tests/core/interlock/link_oracles.hpp"
#include "tests/core/interlock/torus_mesh.hpp"

using namespace pliant;
using namespace pliant::interlock;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Cells with every kind of pair that counts: curves, a rod, a plate, a loose ball and a body with a mesh for surface.
std::vector<UnitCell> cells() {
  std::vector<UnitCell> result = {fourInOne(), threefold(), torusKnot(), scaleMail()};
  UnitCell mixed;
  mixed.name = "mixed";
  mixed.lattice = 22e-3 * Eigen::Matrix2d::Identity();
  Eigen::Matrix3Xd corners(3, 4);
  corners << 0, 2e-3, 0, 0, 0, 0, 2e-3, 0, 0, 0, 0, 2e-3;
  SimplexSet ball;
  ball.corners = Vector3d::Zero();
  ball.points = {0};
  mixed.shapes = {{"ring", {wire(ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), 4e-3), 0.6e-3)}},
                  {"rod", {capsule({-2e-3, 0, 0}, {2e-3, 1e-3, 0}, 0.5e-3)}},
                  {"body", {dilatedMesh({corners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, {}, {}}, 0.3e-3)}},
                  {"ball", {{ball, 0.6e-3}}}};
  // Around the ring, with gaps of some tenths of a millimetre: each kind of pair occurs.
  const auto place = [&](int shape, double x, double y, double z, double turn) {
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn, Vector3d::UnitZ()).toRotationMatrix();
    mixed.elements.push_back({shape, 1e-3 * Vector3d(x, y, z), rotation});
  };
  place(0, 0, 0, 0, 0);
  place(3, 4, 0, 1.5, 0);
  place(3, 4.3, 0.5, 3, 0);
  place(1, 0, 4, 1.4, 0);
  place(1, 0.4, 4.1, 2.7, 0.5);
  place(2, -5.5, -1, 1.3, 0);
  place(2, -5.6, -1.2, 4.2, 0.3);
  place(2, -2.8, 1.7, 1.3, 3.05);
  place(3, -4.2, 0.2, 3.0, 0);
  result.push_back(mixed);
  // Rings that are meshes without dilation, and two of their edges nearly parallel, so that the mollifier counts.
  UnitCell meshes = fourInOne();
  meshes.name = "meshes";
  meshes.shapes[0].pieces = {dilatedMesh(torusMesh(5e-3, 0.8e-3, 14, 5), 0)};
  result.push_back(meshes);
  UnitCell bars;
  bars.name = "bars";
  bars.lattice = 22e-3 * Eigen::Matrix2d::Identity();
  corners << -2e-3, 2e-3, 0, 0, 0, 0, 0.1e-3, 0, 0, 0, 1e-3, 2e-3;
  bars.shapes = {{"bar", {dilatedMesh({corners, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}, {}, {}}, 0)}}};
  const Eigen::Matrix3d turned =
      (Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()) * Eigen::AngleAxisd(0.01, Vector3d::UnitZ()))
          .toRotationMatrix();
  bars.elements = {{0, Vector3d::Zero(), Eigen::Matrix3d::Identity()}, {0, Vector3d(0.4e-3, 0, -0.3e-3), turned}};
  result.push_back(bars);
  return result;
}

CellState moderatelyMoved(const UnitCell& cell, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const CellContact contact(cell);
  VectorXd velocity(contact.coordinateCount());
  for (Eigen::Index i = 0; i < velocity.size(); ++i) velocity[i] = unit(random) * (i % 6 < 3 ? 1e-4 : 0.02);
  velocity.tail<3>() = 0.01 * Vector3d(unit(random), unit(random), unit(random));
  for (double step = 1; step > 1e-3; step *= 0.5) {
    const CellState state = moved(restState(cell), velocity, step);
    if (contact.smallestGap(state, 1e-3) > 0.03e-3) return state;
  }
  qFatal("the cell cannot be moved");
}

}  // namespace

class TestCellContact : public QObject {
  Q_OBJECT

 private slots:
  /// First and second differences of the energy in every coordinate, also with arcs cut and for a cell that holds every
  /// kind of pair.
  void finiteDifferences() {
    for (const UnitCell& cell : cells())
      for (const int split : {1, 3}) {
        const CellContact contact(cell);
        const CellState state = moderatelyMoved(cell, 5);
        const CellContact::Barrier barrier{1, 1.2e-3, split};
        const auto pairs = contact.nearParts(state, 2e-3);
        VectorXd gradient;
        MatrixXd hessian;
        const double energy = contact.energy(state, pairs, barrier, &gradient, &hessian);
        QVERIFY(std::isfinite(energy) && energy > 0);
        QVERIFY((hessian - hessian.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * hessian.cwiseAbs().maxCoeff());
        const int size = contact.coordinateCount();
        // Coordinates that are lengths, so that derivatives compare.
        VectorXd scale = VectorXd::Constant(size, 1);
        for (int i = 0; i < size; ++i)
          if (i >= size - 3 || i % 6 >= 3) scale[i] = 200;  // 1/(5 mm)
        double worst = 0, worstHessian = 0;
        for (int i = 0; i < size; ++i) {
          const double h = 2e-9;
          const VectorXd velocity = VectorXd::Unit(size, i) * scale[i];
          // The exponential's increment is taken anew at each point, so second derivatives are those of the energy
          // along one increment: the symmetric part is compared through the energy itself as well.
          VectorXd ahead, behind;
          const double up = contact.energy(moved(state, velocity, h), pairs, barrier, &ahead);
          const double down = contact.energy(moved(state, velocity, -h), pairs, barrier, &behind);
          worst = std::max(worst, std::abs((up - down) / (2 * h) - gradient[i] * scale[i]));
          const double k = 2e-8;  // the Hessian of a mesh jumps where nearest places go on to other parts
          const double far = contact.energy(moved(state, velocity, k), pairs, barrier);
          const double back = contact.energy(moved(state, velocity, -k), pairs, barrier);
          const double second = (far - 2 * energy + back) / (k * k);
          worstHessian = std::max(worstHessian, std::abs(second - hessian(i, i) * scale[i] * scale[i]));
        }
        const double size1 = (gradient.array() * scale.array()).matrix().norm();
        const double size2 = (scale.asDiagonal() * hessian * scale.asDiagonal()).norm();
        QVERIFY2(worst < 1e-6 * size1, qPrintable(QString("%1 %2").arg(cell.name.c_str()).arg(worst / size1)));
        QVERIFY2(
            worstHessian < 2e-4 * size2, qPrintable(QString("%1 %2").arg(cell.name.c_str()).arg(worstHessian / size2)));
      }
  }

  /// The bars of the last cell count with a mollifier that is neither 0 nor 1.
  void mollifierCounts() {
    const UnitCell bars = cells().back();
    const SimplexSet& set = std::get<SimplexSet>(bars.shapes[0].pieces[0].core);
    const auto cornerOf = [&](int element, int corner) -> Vector3d {
      return bars.elements[element].rotation * set.corners.col(corner) + bars.elements[element].position;
    };
    geometry::Corners edges;
    edges << cornerOf(0, 0), cornerOf(0, 1), cornerOf(1, 0), cornerOf(1, 1);
    const double fade = geometry::edgeMollifier(edges, geometry::edgeMollifierScale(edges), nullptr, nullptr);
    QVERIFY2(fade > 0.1 && fade < 0.9, qPrintable(QString::number(fade)));
    QVERIFY(std::sqrt(geometry::closestPoints(geometry::SimplexPair::edgeEdge, edges).squaredDistance) < 0.5e-3);
  }

  /// Mixed second derivatives, along random directions in all coordinates at once. Along a motion whose increments are
  /// multiples of one velocity, the slope of the energy is gradient · velocity at every point.
  void secondDerivativesAlongDirections() {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (const UnitCell& cell : cells()) {
      const CellContact contact(cell);
      const CellState state = moderatelyMoved(cell, 11);
      const CellContact::Barrier barrier{1, 1.2e-3};
      const auto pairs = contact.nearParts(state, 2e-3);
      VectorXd gradient;
      MatrixXd hessian;
      contact.energy(state, pairs, barrier, &gradient, &hessian);
      const int size = contact.coordinateCount();
      for (int trial = 0; trial < 20; ++trial) {
        VectorXd velocity(size);
        for (int i = 0; i < size; ++i) velocity[i] = normal(random) * (i >= size - 3 || i % 6 >= 3 ? 200 : 1);
        const double h = 1e-9;
        VectorXd ahead, behind;
        contact.energy(moved(state, velocity, h), pairs, barrier, &ahead);
        contact.energy(moved(state, velocity, -h), pairs, barrier, &behind);
        const double second = (ahead - behind).dot(velocity) / (2 * h);
        const double expected = velocity.dot(hessian * velocity);
        QVERIFY2(
            std::abs(second - expected) < 1e-5 * std::abs(expected),
            qPrintable(QString("%1: %2 %3").arg(cell.name.c_str()).arg(second, 0, 'g', 9).arg(expected, 0, 'g', 9)));
      }
    }
  }

  /// The smallest gap of deformed cells of curves against all pairs of samples of all images nearby.
  void smallestGapOfCurves() {
    for (const UnitCell& cell : {fourInOne(), threefold(), torusKnot(), ringNet()})
      for (unsigned seed = 1; seed < 4; ++seed) {
        const CellContact contact(cell);
        const CellState state = moderatelyMoved(cell, seed);
        double expected = 1;
        const int count = static_cast<int>(cell.elements.size());
        for (int a = 0; a < count; ++a)
          for (int b = 0; b < count; ++b)
            for (int i = -2; i <= 2; ++i)
              for (int j = -2; j <= 2; ++j) {
                if (a == b && i == 0 && j == 0) continue;
                const Vector3d offset = contact.offsetOf(state, a, b, {i, j});
                if (offset.norm() > 24e-3) continue;
                for (const DilatedPiece& pieceA : cell.shapes[0].pieces)
                  for (const DilatedPiece& pieceB : cell.shapes[0].pieces) {
                    const ClosedCurve curveA = std::get<ClosedCurve>(pieceA.core).rotated(state.rotations[a]);
                    const ClosedCurve curveB = std::get<ClosedCurve>(pieceB.core).rotated(state.rotations[b]);
                    if ((curveA.centre() + offset - curveB.centre()).norm() > 17e-3) continue;
                    expected =
                        std::min(expected, sampledDistance(curveA, curveB, offset) - pieceA.radius - pieceB.radius);
                  }
              }
        const double found = contact.smallestGap(state, 5e-3);
        QVERIFY2(std::abs(found - expected) < 1e-9,
                 qPrintable(QString("%1: %2 %3").arg(cell.name.c_str()).arg(found).arg(expected)));
      }
  }

  /// A rod against a plate, a ball against a ring, two balls: closed forms.
  void gapsOfSimplices() {
    UnitCell cell;
    Eigen::Matrix3Xd square(3, 4);
    square << -3, 3, 3, -3, -3, -3, 3, 3, 0, 0, 0, 0;
    SimplexSet point;
    point.corners = Vector3d::Zero();
    point.points = {0};
    cell.shapes = {{"plate", {roundedPolygon(square, 0.5)}},
                   {"rod", {capsule({0, 0, 0}, {0, 0, 4}, 0.25)}},
                   {"ball", {{point, 1}}},
                   {"ring", {wire(ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), 5), 0.5)}}};
    cell.lattice = 1000 * Eigen::Matrix2d::Identity();
    const auto gapOf = [&](int first, const Vector3d& x, int second, const Vector3d& y) {
      cell.elements = {{first, x, Eigen::Matrix3d::Identity()}, {second, y, Eigen::Matrix3d::Identity()}};
      return CellContact(cell).smallestGap(restState(cell), 100);
    };
    const auto compare = [](double found, double expected) { return std::abs(found - expected) < 1e-12 * 100; };
    QVERIFY(compare(gapOf(0, {0, 0, 0}, 1, {1, 2, 2}), 2 - 0.75));   // end of a rod above a plate
    QVERIFY(compare(gapOf(0, {0, 0, 0}, 1, {5, 0, -2}), 2 - 0.75));  // middle of a rod beside its side
    QVERIFY(compare(gapOf(0, {0, 0, 0}, 2, {6, 7, 0}), 5 - 1.5));    // ball beside a corner
    QVERIFY(compare(gapOf(2, {0, 0, 0}, 2, {3, 4, 12}), 13 - 2));    // two balls
    QVERIFY(compare(gapOf(3, {0, 0, 0}, 2, {8, 0, 4}), 5 - 1.5));    // ball beside a ring
    QVERIFY(compare(gapOf(3, {0, 0, 0}, 1, {2, 0, -1}), 3 - 0.75));  // rod through a ring
    QVERIFY(compare(gapOf(3, {0, 0, 10}, 0, {0, 0, 0}), std::sqrt(100 + std::pow(5 - std::sqrt(18.0), 2)) - 1));
    QVERIFY(compare(gapOf(0, {0, 0, 0}, 0, {0, 7, 0}), 1 - 1));    // two plates side by side
    QVERIFY(compare(gapOf(1, {0, 0, 0}, 1, {3, 0, 1}), 3 - 0.5));  // parallel rods
  }
};

QTEST_GUILESS_MAIN(TestCellContact)
#include "test_cell_contact.moc"
