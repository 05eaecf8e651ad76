#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>
#include <random>

#include "core/base/error.hpp"
#include "core/interlock/deformation_test.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/linking_number.hpp"
#include "core/interlock/live_cell.hpp"

using namespace pliant::interlock;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

std::vector<UnitCell> materials() { return {fourInOne(), threefold(), torusKnot(), scaleMail(), ringNet()}; }

/// Of a pull on a random place of a cell, at a random place.
struct RandomPull {
  CellGrip grip;
  Vector3d hand;
};

RandomPull randomPull(const UnitCell& cell, std::mt19937& random, double far) {
  const auto number = [&] { return 2 * (random() / 4294967296.0) - 1; };
  const double length = std::sqrt(cell.lattice.determinant());
  RandomPull pull;
  pull.grip.element = static_cast<int>(random() % cell.elements.size());
  pull.grip.arm = 0.4 * length * Vector3d(number(), number(), number());
  pull.grip.shift = {std::round(1.5 * number()), std::round(1.5 * number())};
  pull.hand = far * length * Vector3d(number(), number(), number());
  return pull;
}

/// What a spring would cost that pulls as hard as a hand does at most, wherever its place is.
double pullEnergy(const LiveCell& live, const RandomPull& pull) {
  const double length = std::sqrt(live.cell().lattice.determinant());
  const double distance = (live.placeOf(pull.grip) - pull.hand).norm() / length;
  return distance < 0.5 ? 0.5 * distance * distance : 0.5 * (distance - 0.25);
}

}  // namespace

class TestLiveCell : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// The pull's derivatives against finite differences, near and beyond where its force is bounded.
  void aPullHasTheDerivativesItSays() {
    const UnitCell cell = fourInOne();
    std::mt19937 random(3);
    const auto number = [&] { return 2 * (random() / 4294967296.0) - 1; };
    for (int k = 0; k < 20; ++k) {
      ElementPull pull;
      pull.element = k % 2;
      pull.spring = 2e4;
      pull.strongest = k < 10 ? std::numeric_limits<double>::infinity() : 50;
      pull.force = 10 * Vector3d(number(), number(), number());
      pull.arm = 5e-3 * Vector3d(number(), number(), number());
      pull.shift = {number(), 2 * number()};
      pull.target = 2e-2 * Vector3d(number(), number(), number());
      CellState state = restState(cell);
      state.strain = 0.1 * Vector3d(number(), number(), number());
      const int size = 15;
      Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
      Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(size, size);
      addDerivatives(cell, state, pull, gradient, &hessian);
      Eigen::VectorXd direction(size);
      for (int i = 0; i < size; ++i) direction[i] = (i % 6 < 3 && i < 12 ? 1e-3 : 0.2) * number();
      const Vector3d before = placeOf(cell, state, pull);
      const auto energyAt = [&](double step) { return energyOf(cell, moved(state, direction, step), pull, before); };
      const double h = 1e-3;
      const double slope = (energyAt(h) - energyAt(-h)) / (2 * h);
      const double bend = (energyAt(h) - 2 * energyAt(0) + energyAt(-h)) / (h * h);
      QVERIFY(std::abs(slope - gradient.dot(direction)) < 1e-5 * (1e-2 + std::abs(slope)));
      QVERIFY(std::abs(bend - direction.dot(hessian * direction)) < 1e-4 * (1e-2 + std::abs(bend)));
    }
  }

  void aHandFarBeyondTheLimitEndsAtTheLimit() {
    for (const UnitCell& cell : materials())
      for (const double angle : {0.0, 0.5 * std::numbers::pi, 0.3}) {
        const double limit = directionLimit(CellSolver(cell), angle, false).strain;
        LiveCell live(cell);
        const Vector2d direction(std::cos(angle), std::sin(angle));
        const double length = std::sqrt(cell.lattice.determinant());
        // A place of the lattice in this direction, pulled to a thousand cells away.
        CellGrip grip;
        grip.shift = cell.lattice.inverse() * (1.5 * length * direction);
        Vector3d hand = live.placeOf(grip);
        hand.head<2>() += 1000 * length * direction;
        live.pull(grip, hand);
        LiveStep step;
        int steps = 0;
        do {
          step = live.advance();
          QVERIFY2(!step.failed(), step.message.c_str());
        } while (!step.settled && ++steps < 200);
        QVERIFY(step.locked && !step.contacts.empty());
        QVERIFY(std::abs(strainAlong(live.state().strain, angle) - limit) < 1e-3);
      }
  }

  /// Hands anywhere, even inside of elements or far away, one after another without rest between them: no overlap, the
  /// same links, and never farther from the hand but for what gaps cost.
  void noHandPullsElementsThroughOneAnother() {
    for (const UnitCell& cell : materials()) {
      std::mt19937 random(7);
      LiveCell live(cell);
      const CellContact contact(cell);
      const LinkFinder finder(contact);
      const auto links = finder.linksAt(live.state());
      QVERIFY(links);
      const double length = std::sqrt(cell.lattice.determinant()), radius = cell.smallestRadius();
      // Of a handful of contacts, each with a gap of a thousandth of the wire, against the strongest pull.
      const double slack = 10 * 0.5 / length * 1e-3 * radius;
      for (int k = 0; k < 12; ++k) {
        const RandomPull wanted = randomPull(cell, random, k % 2 ? 1 : 30);
        live.pull(wanted.grip, wanted.hand);
        double energy = pullEnergy(live, wanted);
        for (int i = 0; i < 3; ++i) {
          const LiveStep step = live.advance();
          QVERIFY2(!step.failed(), step.message.c_str());
          QVERIFY(contact.smallestGap(live.state(), radius) > 0);
          QVERIFY(finder.linksAt(live.state()) == links);
          const double next = pullEnergy(live, wanted);
          QVERIFY2(next <= energy + slack, qPrintable(QString("%1 after %2").arg(next).arg(energy)));
          energy = next;
        }
      }
    }
  }

  /// A hand that asks for what is free gets it; nothing moves without one, and a reset is a reset.
  void aHandWithinReachIsFollowed() {
    const UnitCell cell = fourInOne();
    LiveCell live(cell);
    const CellState rest = live.state();
    CellGrip grip;
    grip.element = 1;
    const Vector3d hand = live.placeOf(grip) + Vector3d(0.2e-3, 0.1e-3, 0.3e-3);
    live.pull(grip, hand);
    LiveStep step;
    for (int i = 0; i < 5; ++i) step = live.advance();
    QVERIFY(step.settled && !step.locked);
    QVERIFY((live.placeOf(grip) - hand).norm() < 1e-3 * std::sqrt(cell.lattice.determinant()));
    live.letGo();
    const CellState before = live.state();
    step = live.advance();
    QVERIFY(step.settled && !step.locked && step.contacts.empty());
    QVERIFY(step.smallestGap > 0);
    QVERIFY(live.state().positions == before.positions && live.state().strain == before.strain);
    live.reset();
    QVERIFY(live.state().positions == rest.positions && live.state().strain == rest.strain);
    QVERIFY(!live.isPulled());
  }

  void aCancelledStepKeepsASoundState() {
    LiveCell live(threefold());
    CellGrip grip;
    grip.shift = {1, 0};
    live.pull(grip, Vector3d(1, 0, 0));
    pliant::base::ExecutionContext cancelled;
    cancelled.requestCancel();
    const CellState before = live.state();
    LiveStep step = live.advance(&cancelled);
    QVERIFY(step.termination == pliant::base::TerminationType::cancelled);
    QVERIFY(!step.settled && !step.failed());
    QVERIFY(live.state().strain == before.strain);
    while (!step.settled) step = live.advance();
    QVERIFY(step.locked);
  }

  void badHandsAreRefused() {
    LiveCell live(threefold());
    CellGrip grip;
    grip.element = 1;
    QVERIFY_EXCEPTION_THROWN(live.pull(grip, Vector3d::Zero()), pliant::base::InputError);
    grip.element = 0;
    QVERIFY_EXCEPTION_THROWN(live.pull(grip, Vector3d(std::nan(""), 0, 0)), pliant::base::InputError);
  }
};

QTEST_GUILESS_MAIN(TestLiveCell)
#include "test_live_cell.moc"
