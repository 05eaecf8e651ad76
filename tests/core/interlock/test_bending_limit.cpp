#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/interlock/bending_limit.hpp"
#include "core/interlock/element_families.hpp"
#include "core/math/parallel.hpp"

using namespace pliant;
using namespace pliant::interlock;
using Eigen::Vector3d;

namespace {

constexpr double pi = std::numbers::pi, ring = 5e-3, wireRadius = 0.4e-3;

/// Three rings in a row along x, linked, with balls in their middles if `ball` is above 0.
UnitCell threeRings(double ball, double spacing) {
  ElementShape shape{"ring", {wire(ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), ring), wireRadius)}};
  if (ball > 0) {
    SimplexSet point;
    point.corners = Eigen::Matrix3Xd::Zero(3, 1);
    point.points = {0};
    shape.pieces.push_back({point, ball});
  }
  UnitCell patch;
  patch.shapes = {shape};
  for (int i = -1; i <= 1; ++i) {
    const double turn = i == 0 ? pi / 2 : 0;
    patch.elements.push_back({0, {i * spacing, 0, 0}, Eigen::AngleAxisd(turn, Vector3d::UnitX()).toRotationMatrix()});
  }
  patch.links = LinkFinder(CellContact(patch)).linksAt(restState(patch)).value();
  return patch;
}

UnitCell sevenScales() {
  PatchOutline outline;
  outline.radius = 1.01 * scaleMail().lattice.col(0).norm();
  return cutPatch(scaleMail(), outline);
}

UnitCell nineThickKnots() {
  TorusKnot knot;
  knot.wire = 0.9e-3;
  PatchOutline outline;
  outline.radius = 1.5 * knot.spacing;
  return cutPatch(torusKnot(knot), outline);
}

BendingOptions oneTrial() {
  BendingOptions options;
  options.trials = 1;
  return options;
}

EquilibriumOptions quick() {
  EquilibriumOptions options;
  options.finalGap = 1e-3;
  options.looseTolerance = 1;
  return options;
}

}  // namespace

class TestBendingLimit : public QObject {
  Q_OBJECT

 private slots:
  /// The outer two of three linked rings fold up until the balls of radius ρ in their middles meet at x = ±ρ. Links are
  /// d = 2 (R - r) long at most, so ½ k ρ² <= sqrt(d² - ρ²), reached: a limit held by elements that are not neighbours.
  void foldedChainEndsWhereBallsMeet() {
    constexpr double ball = 3.6e-3, longest = 2 * (ring - wireRadius);
    const double exact = 2 * std::sqrt(longest * longest - ball * ball) / (ball * ball);
    const UnitCell patch = threeRings(ball, 9.1e-3);
    checkShape(patch.shapes[0]);
    const PatchSolver solver(patch);
    BendingOptions options = oneTrial();
    options.lateral = Lateral::held;
    for (const bool down : {false, true}) {
      const BendingLimit limit = bendingLimit(solver, 0, down, options);
      QVERIFY2(limit.equilibrium.converged(), limit.equilibrium.message.c_str());
      const double reached = down ? -limit.curvature : limit.curvature;
      QVERIFY2(reached < exact && reached > exact * (1 - 1e-4), qPrintable(QString::number(reached / exact, 'g', 9)));
      QCOMPARE(limit.orthogonal, 0.0);
      QVERIFY(limit.kind == BendingKind::folded && limit.remoteShare > 0.1);
    }
  }

  void looseChainFoldsWithoutLimit() {
    const PatchSolver solver(threeRings(0, 7e-3));
    const BendingLimit limit = bendingLimit(solver, 0, false, oneTrial());
    QVERIFY(limit.equilibrium.converged());
    QVERIFY(limit.equilibrium.kind == RestKind::unlimited && limit.kind == BendingKind::folded);
    QVERIFY(limit.steepest > steepestSlope);
  }

  /// Symmetries that nothing in the computation knows of: scales turned by 60 degrees are the same, and knots turned
  /// upside down about a lattice vector.
  void limitsHaveTheSymmetriesOfTheirElements() {
    base::ExecutionContext context;
    const PatchSolver scales(sevenScales(), quick());
    const auto of = bendingLimits(scales, {pi / 6, pi / 2}, oneTrial(), context);
    for (const auto limit : {&BendingLimits::up, &BendingLimits::down}) {
      const BendingLimit &first = of[0].*limit, &second = of[1].*limit;
      QVERIFY(first.kind == BendingKind::locked && second.kind == BendingKind::locked);
      QVERIFY2(std::abs(first.curvature / second.curvature - 1) < 2e-3,
               qPrintable(QString("%1 and %2").arg(first.curvature).arg(second.curvature)));
    }
    // Plates on top meet when it is bent up: thesis Fig. 4.12.
    QVERIFY(of[0].up.curvature < -0.5 * of[0].down.curvature);

    const PatchSolver knots(nineThickKnots(), quick());
    const auto both = bendingLimits(knots, {0}, oneTrial(), context);
    QVERIFY(both[0].up.kind == BendingKind::locked && both[0].down.kind == BendingKind::locked);
    QVERIFY(std::abs(both[0].up.curvature / both[0].down.curvature + 1) < 5e-3);
    for (const BendingLimit& limit : {of[0].up, of[0].down}) {
      QVERIFY(scales.contact().smallestGap(limit.equilibrium.state, scales.radius()) > 0);
      QVERIFY(LinkFinder(scales.contact()).linksAt(limit.equilibrium.state) == scales.patch().links);
    }
  }

  /// Threefold elements may turn either way as they are bent to a dome, and lock earlier one way than the other: of
  /// some trials the farthest is the same up and down, as it must be, since turning the patch over about the middle of
  /// a ring maps it to itself.
  void trialsFindTheFarthestBranch() {
    PatchOutline outline;
    outline.radius = 14e-3;
    const PatchSolver solver(cutPatch(threefold({5.2e-3, 1.6e-3, 5e-3, 50 * pi / 180, 13.5e-3}), outline), quick());
    const CellState start = solver.relaxed(restState(solver.patch()));
    BendingOptions options;
    options.trials = 8;
    std::array<double, 2> limits{};
    for (int i = 0; i < 2; ++i) {
      const CellEquilibrium rest =
          farthestBend(solver, start, rayDrive(Vector3d(i == 0 ? 1 : -1, 0, 0)), options, nullptr);
      QVERIFY2(rest.converged(), rest.message.c_str());
      limits[i] = std::abs(rest.state.strain[0]);
    }
    QVERIFY2(std::abs(limits[0] / limits[1] - 1) < 5e-3, qPrintable(QString("%1 %2").arg(limits[0]).arg(limits[1])));
  }

  /// On the paraboloid, not drifting off its apex nor turning about its axis.
  void patchesStayWhereTheyBelong() {
    const PatchSolver solver(sevenScales(), quick());
    const BendingLimit limit = bendingLimit(solver, 0.4, false, oneTrial());
    const CellState& state = limit.equilibrium.state;
    const auto [mean, deviator, twist] = std::array{state.strain[0], state.strain[1], state.strain[2]};
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double turn = 0;
    for (std::size_t i = 0; i < solver.patch().elements.size(); ++i) {
      const Vector3d place = state.positions.col(static_cast<Eigen::Index>(i));
      const Vector3d rest = solver.patch().elements[i].position;
      const double height =
          0.5 * ((mean + deviator) * place.x() * place.x() + (mean - deviator) * place.y() * place.y()) +
          twist * place.x() * place.y();
      QVERIFY(std::abs(place.z() - height) < 1e-12);
      sum += place.head<2>();
      turn += rest.x() * place.y() - rest.y() * place.x();
    }
    QVERIFY(sum.norm() < 1e-9 * solver.radius());
    QVERIFY(std::abs(turn) < 1e-9 * solver.radius() * solver.extent());
    // Principal directions are those asked for.
    QVERIFY(std::abs(std::sin(0.8) * deviator - std::cos(0.8) * twist) < 1e-9 * std::abs(mean));
  }

  void sameForAnyNumberOfThreads() {
    const PatchSolver solver(nineThickKnots(), quick());
    std::vector<std::vector<BendingLimits>> runs;
    for (const int threads : {1, 2}) {
      math::setThreadCount(threads);
      base::ExecutionContext context;
      runs.push_back(bendingLimits(solver, {0.1, 0.7}, oneTrial(), context));
      QCOMPARE(context.progress(), 1.0);
    }
    math::setThreadCount(0);
    for (int i = 0; i < 2; ++i) {
      QVERIFY(runs[0][i].up.curvature == runs[1][i].up.curvature);
      QVERIFY(runs[0][i].down.equilibrium.state.positions == runs[1][i].down.equilibrium.state.positions);
    }
    base::ExecutionContext cancelled;
    cancelled.requestCancel();
    QVERIFY(bendingLimit(solver, 0, false, oneTrial(), &cancelled).kind == BendingKind::unsettled);
  }
};

QTEST_GUILESS_MAIN(TestBendingLimit)
#include "test_bending_limit.moc"
