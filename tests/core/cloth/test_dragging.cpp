#include <QTest>

#include "core/base/error.hpp"
#include "core/cloth/dragging.hpp"
#include "tests/core/cloth/cloth_examples.hpp"

using namespace pliant;
using cloth::ClothSimulation;
using cloth::Dragging;

namespace {

constexpr double timeStep = 0.01, side = 0.5, limit = 1.05;
constexpr double kept = 1e-6;  // of the limit

ClothSimulation hangingSheet() {
  auto problem =
      test::withLimit(test::hungByCorners(test::withGravity(test::sheetProblem(6, side), {0, 0, -9.81})), limit);
  cloth::SteppingOptions options;
  options.scheme = cloth::SteppingScheme::stepAndProject;
  options.timeStep = timeStep;
  return ClothSimulation(std::make_shared<const cloth::ClothProblem>(std::move(problem)), options);
}

/// The node that rests at (x, y, 0).
int nodeAt(const ClothSimulation& simulation, double x, double y) {
  Eigen::Index node;
  const auto rest = simulation.problem().model->restPositions.reshaped(3, simulation.state().positions.cols());
  (rest.colwise() - Eigen::Vector3d(x, y, 0)).colwise().squaredNorm().minCoeff(&node);
  return static_cast<int>(node);
}

}  // namespace

class TestDragging : public QObject {
  Q_OBJECT

 private slots:
  void aPulledNodeGoesToTheHandAtABoundedSpeed() {
    ClothSimulation simulation = hangingSheet();
    Dragging dragging(simulation);
    const int node = nodeAt(simulation, side, side / 2);
    const Eigen::Vector3d hand(0.2, 0.2, 0.15);
    base::ExecutionContext context;
    dragging.pull(node, hand);
    Eigen::Vector3d before = simulation.state().positions.col(node);
    const auto expected = static_cast<int>(std::ceil((hand - before).norm() / dragging.reach()));
    QVERIFY(expected > 3);
    for (int i = 1; i <= expected; ++i) {
      const cloth::StepRecord record = dragging.step(context);
      QVERIFY(record.done());
      QVERIFY(record.violation < kept);
      const Eigen::Vector3d now = simulation.state().positions.col(node);
      QVERIFY((now - before).norm() < dragging.reach() * (1 + 1e-12));
      before = now;
      QCOMPARE(now == hand, i == expected);
    }
    QVERIFY(dragging.obstacle().empty());
    // There it stays for as long as it is held.
    QVERIFY(dragging.step(context).done());
    QVERIFY(simulation.state().positions.col(node) == hand);
  }

  void limitsStopAHandThatPullsTooFar() {
    ClothSimulation simulation = hangingSheet();
    Dragging dragging(simulation);
    const int node = nodeAt(simulation, side, side / 2), corner = nodeAt(simulation, 0, side / 2);
    const Eigen::Vector3d pinned = simulation.state().positions.col(corner);
    base::ExecutionContext context;
    dragging.pull(node, pinned + Eigen::Vector3d(3, 0, 0));
    double farthest = 0;
    int held = 0;
    for (int i = 0; i < 60; ++i) {
      const cloth::StepRecord record = dragging.step(context);
      QVERIFY2(record.done(), record.message.c_str());
      QCOMPARE(simulation.state().time, record.time);
      QVERIFY(record.violation < kept);
      farthest = std::max(farthest, (simulation.state().positions.col(node) - pinned).norm());
      held += !dragging.obstacle().empty();
    }
    QVERIFY(std::abs(simulation.state().time - 60 * timeStep) < 1e-12);
    // The edge between them is `side` long at rest. A step of the least length is refused in the end.
    QVERIFY(farthest <= limit * (1 + kept) * side);
    QVERIFY(farthest > limit * side - dragging.reach());
    QVERIFY(held > 0);
    QVERIFY(!dragging.obstacle().empty());
    // A hand that comes back is followed at once.
    dragging.pull(node, pinned + Eigen::Vector3d(0.4, 0, 0));
    const Eigen::Vector3d before = simulation.state().positions.col(node);
    QVERIFY(dragging.step(context).done());
    QVERIFY(simulation.state().positions(0, node) < before.x());
    for (int i = 0; i < 30; ++i) dragging.step(context);
    QVERIFY(dragging.obstacle().empty());
  }

  void whatIsLetGoFallsOrStays() {
    ClothSimulation simulation = hangingSheet();
    Dragging dragging(simulation);
    const int free = nodeAt(simulation, side, side / 2), locked = nodeAt(simulation, 0, side / 2);
    const int kept = nodeAt(simulation, side, -side / 2);
    const Eigen::Vector3d shift(-0.02, 0, 0.01);
    base::ExecutionContext context;
    std::map<int, Eigen::Vector3d> hands;
    for (const int node : {free, locked, kept}) {
      hands[node] = simulation.state().positions.col(node) + shift;
      dragging.pull(node, hands[node]);
    }
    for (int i = 0; i < 10; ++i) QVERIFY(dragging.step(context).done());
    for (const auto& [node, hand] : hands) QVERIFY(simulation.state().positions.col(node) == hand);
    dragging.letGo(free, false);
    dragging.letGo(locked, false);
    dragging.letGo(kept, true);
    QCOMPARE(dragging.hands().size(), std::size_t(2));
    for (int i = 0; i < 5; ++i) QVERIFY(dragging.step(context).done());
    QVERIFY(simulation.state().positions(2, free) < hands[free].z() - 1e-3);
    QVERIFY(simulation.state().positions.col(locked) == hands[locked]);
    QVERIFY(simulation.state().positions.col(kept) == hands[kept]);
  }

  void badHandsAreRefused() {
    ClothSimulation simulation = hangingSheet();
    Dragging dragging(simulation);
    QVERIFY_EXCEPTION_THROWN(dragging.pull(-1, Eigen::Vector3d::Zero()), base::InputError);
    QVERIFY_EXCEPTION_THROWN(dragging.pull(10'000, Eigen::Vector3d::Zero()), base::InputError);
    QVERIFY_EXCEPTION_THROWN(dragging.pull(0, Eigen::Vector3d(0, NAN, 0)), base::InputError);
    dragging.letGo(3, false);
    QVERIFY(dragging.hands().empty());
  }
};

QTEST_GUILESS_MAIN(TestDragging)
#include "test_dragging.moc"
