#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/interlock/deformation_test.hpp"
#include "core/interlock/element_families.hpp"
#include "tests/core/interlock/link_oracles.hpp"

using namespace pliant::interlock;
using Eigen::Vector3d;

namespace {

constexpr double ring = 5e-3, wireRadius = 0.8e-3;

/// Rings in a row along x, each turned by 90 degrees against the one before and linked with it, far from their images.
UnitCell chain(int count) {
  UnitCell cell;
  cell.shapes = {{"ring", {wire(ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), ring), wireRadius)}}};
  for (int i = 0; i < count; ++i) {
    const double turn = i % 2 * std::numbers::pi / 2;
    cell.elements.push_back({0, {i * 6e-3, 0, 0}, Eigen::AngleAxisd(turn, Vector3d::UnitX()).toRotationMatrix()});
  }
  cell.lattice = 200e-3 * Eigen::Matrix2d::Identity();
  cell.links = LinkFinder(CellContact(cell)).linksAt(restState(cell)).value();
  return cell;
}

/// No strain; the last ring is pulled, or drawn to the first one's centre.
StrainDrive ringDrive(int count, bool pull) {
  StrainDrive drive;
  drive.directions.resize(3, 0);
  ElementPull on;
  on.element = count - 1;
  if (pull)
    on.force = Vector3d(1000, 0, 0);
  else
    on.spring = 1e6;
  drive.pulls = {on};
  return drive;
}

CellEquilibrium pulledChain(int count, bool pull, double finalGap) {
  EquilibriumOptions options;
  options.finalGap = finalGap;
  const CellSolver solver(chain(count), options);
  return solver.solve(solver.perturbed(restState(chain(count)), 0.01, 1), ringDrive(count, pull));
}

double distanceOfEnds(const CellEquilibrium& rest) {
  return (rest.state.positions.rightCols<1>() - rest.state.positions.leftCols<1>()).norm();
}

/// The farthest strain of 4-in-1 along x (or y) with its other side held, if it keeps its symmetries, which leave one
/// unknown, the tilt. Found by bisection and golden section on sampled distances alone.
double symmetricLimit(bool alongX) {
  const FourInOne parameters;
  const auto isFree = [&](double strain, double tilt) {
    const auto turned = [](double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix(); };
    const ClosedCurve circle = ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), parameters.ring);
    const Vector3d offset(
        0.5 * parameters.width * (alongX ? 1 + strain : 1), 0.5 * parameters.height * (alongX ? 1 : 1 + strain), 0);
    return sampledDistance(circle.rotated(turned(-tilt)), circle.rotated(turned(tilt)), offset, 90) >
           2 * parameters.wire;
  };
  const auto limitAt = [&](double tilt) {
    if (!isFree(0, tilt)) return -1.0;
    double low = 0, high = 0.5;
    for (int i = 0; i < 26; ++i) {
      const double middle = 0.5 * (low + high);
      (isFree(middle, tilt) ? low : high) = middle;
    }
    return low;
  };
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double low = 0.1, high = 1.4;
  // From the tilts at which the cell is free at rest, around that of the cell itself.
  while (limitAt(low) < 0) low += 0.02;
  while (limitAt(high) < 0) high -= 0.02;
  for (int i = 0; i < 40; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (limitAt(a) > limitAt(b))
      high = b;
    else
      low = a;
  }
  return limitAt(0.5 * (low + high));
}

}  // namespace

class TestCellEquilibrium : public QObject {
  Q_OBJECT

 private slots:
  /// 2 r <= distance of centres <= 2 (R - r), both reached: what is missing is the gap that is left, which is no larger
  /// than asked for.
  void twoLinkedRings() {
    for (const bool pull : {true, false}) {
      const double exact = pull ? 2 * (ring - wireRadius) : 2 * wireRadius;
      for (const double gap : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        const CellEquilibrium rest = pulledChain(2, pull, gap);
        QVERIFY2(rest.converged() && rest.kind == RestKind::locked, rest.message.c_str());
        const double missing = pull ? exact - distanceOfEnds(rest) : distanceOfEnds(rest) - exact;
        QVERIFY(missing > 0);  // contact never gives way
        QVERIFY2(missing < 1.1 * gap * wireRadius, qPrintable(QString("%1 at %2").arg(missing).arg(gap)));
        if (gap <= 1e-5) QVERIFY(missing < 1e-5 * exact);
        // In a straight pull there is one place of contact, and the least gap is what is missing.
        if (pull) QVERIFY(std::abs(missing - rest.smallestGap) < 1e-3 * missing);
      }
    }
  }

  void chainsAreAsLongAsTheirLinks() {
    for (const int count : {3, 4, 6}) {
      const double exact = (count - 1) * 2 * (ring - wireRadius);
      const CellEquilibrium rest = pulledChain(count, true, 1e-5);
      QVERIFY2(rest.converged(), rest.message.c_str());
      const double length = distanceOfEnds(rest);
      QVERIFY2(length < exact && length > exact * (1 - 1e-5), qPrintable(QString::number(length / exact, 'g', 9)));
    }
  }

  /// Ring net: |F e| · spacing <= 4 (R - r) for both axes e, reached wherever stretch is what stops it.
  void ringNetHasExactFaces() {
    const RingNet parameters;
    const UnitCell cell = ringNet(parameters);
    EquilibriumOptions options;
    options.finalGap = 1e-5;
    const CellSolver solver(cell, options);
    const double largest = 4 * (parameters.ring - parameters.wire) / parameters.spacing;
    const CellState start = solver.perturbed(restState(cell), 0.01, 3);
    for (int k = 0; k < 24; ++k) {
      const double height = 0.35 + 0.6 * k / 23, angle = 2.4 * k, across = std::sqrt(1 - height * height);
      const Vector3d direction(height, across * std::cos(angle), across * std::sin(angle));
      const CellEquilibrium rest = solver.solve(start, rayDrive(direction));
      QVERIFY2(rest.converged(), rest.message.c_str());
      const Eigen::Matrix2d stretch = stretchOf(rest.state.strain);
      const double longest = std::max(stretch.col(0).norm(), stretch.col(1).norm());
      QVERIFY2(
          longest < largest && longest > largest * (1 - 1e-5), qPrintable(QString::number(longest / largest, 'g', 9)));
    }
  }

  /// 4-in-1 along its axes of symmetry against an independent search.
  void fourInOneInSymmetricDirections() {
    for (const bool alongX : {true, false}) {
      EquilibriumOptions options;
      options.finalGap = 1e-5;
      const CellSolver solver(fourInOne(), options);
      LimitOptions limits;
      limits.lateral = Lateral::held;
      limits.perturbation = 0;
      const DirectionLimit limit = directionLimit(solver, alongX ? 0 : std::numbers::pi / 2, false, limits);
      QVERIFY2(limit.equilibrium.converged(), limit.equilibrium.message.c_str());
      const double expected = symmetricLimit(alongX);
      QVERIFY2(std::abs(limit.strain - expected) < 1e-5,
               qPrintable(QString("%1 %2").arg(limit.strain, 0, 'g', 9).arg(expected, 0, 'g', 9)));
    }
  }

  /// What is said to remain beyond the limit covers what smaller gaps gain.
  void remainingStrainIsABound() {
    for (const UnitCell& cell : {fourInOne(), threefold(), torusKnot(), scaleMail()}) {
      double before = 0, remaining = 0;
      for (const double gap : {1e-3, 1e-4, 1e-5}) {
        EquilibriumOptions options;
        options.finalGap = gap;
        LimitOptions limits;
        limits.perturbation = 0;
        const CellSolver solver(cell, options);
        const DirectionLimit limit = directionLimit(solver, 0.3, false, limits);
        QVERIFY2(limit.equilibrium.converged(), limit.equilibrium.message.c_str());
        QVERIFY(limit.equilibrium.meanGap <= gap * cell.smallestRadius());
        if (before > 0) {
          QVERIFY(limit.strain > before);
          QVERIFY2(
              limit.strain < before + 1.5 * remaining,
              qPrintable(QString("%1: %2 of %3").arg(cell.name.c_str()).arg(limit.strain - before).arg(remaining)));
        }
        before = limit.strain;
        remaining = limit.equilibrium.remaining;
      }
    }
  }

  /// Stretch limits hold for larger cells as well, to within the gaps.
  void stretchLimitsSurviveSupercells() {
    for (const UnitCell& cell : {threefold(), torusKnot()})
      for (const double angle : {0.0, 0.5}) {
        const CellSolver solver(cell), larger(supercell(cell, 2, 1));
        const DirectionLimit one = directionLimit(solver, angle, false), two = directionLimit(larger, angle, false);
        QVERIFY(one.equilibrium.converged() && two.equilibrium.converged());
        QVERIFY2(std::abs(one.strain - two.strain) < 3e-4,
                 qPrintable(QString("%1 %2 %3").arg(cell.name.c_str()).arg(one.strain).arg(two.strain)));
      }
  }

  void unlinkedCellsHaveNoLimit() {
    UnitCell cell = chain(1);
    cell.lattice = 15e-3 * Eigen::Matrix2d::Identity();
    const CellSolver solver(cell);
    const DirectionLimit limit = directionLimit(solver, 0, false);
    QVERIFY(limit.equilibrium.converged());
    QVERIFY(limit.equilibrium.kind == RestKind::unlimited);
  }

  void stopsWhereAsked() {
    const CellSolver solver(threefold());
    StrainDrive drive = rayDrive({0, 1, 0});
    drive.farthest = 0.02;
    const CellEquilibrium rest = solver.solve(restState(threefold()), drive);
    QVERIFY(rest.converged() && rest.kind == RestKind::reached);
    QVERIFY((rest.state.strain - Vector3d(0, 0.02, 0)).norm() < 1e-12);
    drive = StrainDrive();
    drive.spring = 1;
    drive.target = {0.01, 0.02, -0.01};
    const CellEquilibrium target = solver.solve(restState(threefold()), drive);
    QVERIFY(target.converged());
    QVERIFY2((target.state.strain - drive.target).norm() < 1e-5,
             qPrintable(QString::number((target.state.strain - drive.target).norm())));
  }

  void badStartsFail() {
    const CellSolver solver(fourInOne());
    CellState overlapping = restState(fourInOne());
    overlapping.positions(2, 1) += 2.5e-3;
    CellEquilibrium rest = solver.solve(overlapping, rayDrive({1, 0, 0}));
    QVERIFY(!rest.converged() && QString(rest.message.c_str()).contains("overlap"));
    CellState unlinked = restState(fourInOne());
    unlinked.positions(2, 1) += 20e-3;
    rest = solver.solve(unlinked, rayDrive({1, 0, 0}));
    QVERIFY(!rest.converged() && QString(rest.message.c_str()).contains("linked"));
    pliant::base::ExecutionContext context;
    context.requestCancel();
    rest = solver.solve(restState(fourInOne()), rayDrive({1, 0, 0}), &context);
    QVERIFY(rest.termination == pliant::base::TerminationType::cancelled);
  }
};

QTEST_GUILESS_MAIN(TestCellEquilibrium)
#include "test_cell_equilibrium.moc"
