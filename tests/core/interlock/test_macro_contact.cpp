#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/hexagon_mesh.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/geometry/triangle_intersection.hpp"
#include "core/interlock/macro_motion.hpp"
#include "tests/core/mechanics/strain_set_examples.hpp"

using namespace pliant;
using Eigen::Vector3d;
using interlock::MacroContact;
using interlock::MacroGrip;
using interlock::MacroLoads;
using interlock::MacroMaterial;
using interlock::MacroMotion;
using interlock::MacroSheet;
using interlock::MacroSimulation;
using interlock::MacroState;
using mechanics::Vector;

namespace {

constexpr double gravity = 9.81, gap = 1e-3;

MacroMaterial mail() {
  MacroMaterial material;
  material.stretch = mechanics::strainSet([](const Vector3d&) { return 0.1; });
  material.bending = mechanics::strainSet([](const Vector3d&) { return 60.0; });
  return material;
}

MacroSheet disk(double radius, int rings) {
  MacroSheet sheet;
  sheet.mesh = geometry::makeDisk(radius, rings);
  sheet.materials = {mail()};
  return sheet;
}

MacroSheet strip(double length, double width, int cells) {
  MacroSheet sheet;
  sheet.mesh = geometry::makeGrid(length, width, cells, std::max(1, static_cast<int>(cells * width / length)));
  sheet.materials = {mail()};
  return sheet;
}

mechanics::Body ball(double radius, const Vector3d& centre = Vector3d::Zero()) {
  mechanics::Body body;
  body.points = body.centre = centre;
  body.radius = radius;
  return body;
}

mechanics::Body ground() {
  mechanics::Body body;
  body.points.resize(3, 4);
  body.points << -1, 1, 1, -1, -1, -1, 1, 1, 0, 0, 0, 0;
  body.triangles = {{0, 1, 2}, {0, 2, 3}};
  return body;
}

Vector raised(const MacroSheet& sheet, const Vector3d& by) { return (sheet.mesh.points.colwise() + by).reshaped(); }

MacroLoads underGravity() {
  MacroLoads loads;
  loads.gravity = {0, 0, -gravity};
  return loads;
}

/// Of all places of the sheet, found by cutting triangles into many, not by the solver's distances [m].
double smallestDistance(const MacroSheet& sheet, const Vector& positions, const Vector3d& centre) {
  constexpr int cuts = 12;
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& nodes : sheet.mesh.triangles)
    for (int i = 0; i <= cuts; ++i)
      for (int j = 0; i + j <= cuts; ++j) {
        const Vector3d place = (i * positions.segment<3>(3 * nodes[0]) + j * positions.segment<3>(3 * nodes[1]) +
                                (cuts - i - j) * positions.segment<3>(3 * nodes[2])) /
                               cuts;
        smallest = std::min(smallest, (place - centre).norm());
      }
  return smallest;
}

bool crossesItself(const MacroSheet& sheet, const Vector& positions) {
  std::vector<std::array<int, 2>> none;
  return !geometry::findIntersections(positions.reshaped(3, positions.size() / 3), sheet.mesh.triangles, none).empty();
}

std::vector<int> nodesBelow(const MacroSheet& sheet, double x) {
  std::vector<int> nodes;
  for (int node = 0; node < sheet.mesh.points.cols(); ++node)
    if (sheet.mesh.points(0, node) < x) nodes.push_back(node);
  return nodes;
}

std::vector<int> nodesAbove(const MacroSheet& sheet, double x) {
  std::vector<int> nodes;
  for (int node = 0; node < sheet.mesh.points.cols(); ++node)
    if (sheet.mesh.points(0, node) > x) nodes.push_back(node);
  return nodes;
}

}  // namespace

class TestMacroContact : public QObject {
  Q_OBJECT

 private slots:
  void groundBearsTheWeight();
  void drapeOverABallGoesNowhereThroughIt();
  void startsThatMeetABodyAreRefused();
  void fallingSheetKeepsItsShape();
  void draggedFallEndsAtItsTerminalVelocity();
  void gripsLeadWhereTheyAreWanted();
  void gripsDoNotPullBeyondLimits();
  void foldedSheetDoesNotCrossItself();
  void ballThatRisesLiftsTheSheet();
  void energyIsNeverGained();
};

void TestMacroContact::groundBearsTheWeight() {
  const MacroSheet sheet = disk(0.1, 4);
  const MacroSimulation simulation(sheet, {}, {{ground()}, gap, false});
  MacroLoads loads = underGravity();
  base::ExecutionContext context;
  const Vector start = raised(sheet, {0, 0, 0.003});
  const MacroState state = simulation.equilibrium(loads, &start, context);
  QVERIFY2(state.report.converged(), state.report.message.c_str());
  const double weight = gravity * simulation.masses().sum();
  QVERIFY(std::abs(state.supported - weight) < 1e-5 * weight);
  QVERIFY(state.smallestGap > 0 && state.smallestGap < gap);
  const auto heights = state.positions.reshaped(3, sheet.mesh.points.cols()).row(2);
  QVERIFY(std::abs(heights.minCoeff() - state.smallestGap) < 1e-12);
  QVERIFY(heights.maxCoeff() < gap);
}

void TestMacroContact::drapeOverABallGoesNowhereThroughIt() {
  const MacroSheet sheet = disk(0.15, 8);
  const double radius = 0.06;
  const MacroSimulation simulation(sheet, {}, {{ball(radius)}, gap, true});
  MacroLoads loads = underGravity();
  for (int node = 0; node < sheet.mesh.points.cols(); ++node)
    if (sheet.mesh.points.col(node).norm() < 0.03) loads.clamped.push_back(node);
  base::ExecutionContext context;
  // A flat middle that is held touches nothing, so that the ball bears the rest.
  const Vector start = raised(sheet, {0, 0, radius + 0.002});
  const MacroState state = simulation.equilibrium(loads, &start, context);
  QVERIFY2(state.report.converged(), state.report.message.c_str());
  QVERIFY(state.violation <= 0);
  const double distance = smallestDistance(sheet, state.positions, Vector3d::Zero()) - radius;
  QVERIFY2(distance > 0, std::to_string(distance).c_str());
  QVERIFY(distance >= state.smallestGap - 1e-12);
  QVERIFY(!crossesItself(sheet, state.positions));
  const auto heights = state.positions.reshaped(3, sheet.mesh.points.cols()).row(2);
  QVERIFY(heights.minCoeff() < 0);  // it hangs down beside the ball
}

void TestMacroContact::startsThatMeetABodyAreRefused() {
  const MacroSheet sheet = disk(0.1, 4);
  const MacroSimulation simulation(sheet, {}, {{ball(0.05)}, gap, false});
  base::ExecutionContext context;
  QVERIFY_THROWS_EXCEPTION(base::InputError, simulation.equilibrium(underGravity(), nullptr, context));
}

/// Implicit Euler's own sum: after n steps of h the velocity's change g h n has led g h² n (n + 1)/2 far.
void TestMacroContact::fallingSheetKeepsItsShape() {
  const MacroSheet sheet = strip(0.1, 0.05, 4);
  const auto simulation = std::make_shared<const MacroSimulation>(sheet, interlock::MacroOptions{});
  MacroMotion motion(simulation, underGravity(), {}, simulation->rest(), {.timeStep = 0.01, .tolerance = 1e-10});
  const Vector3d thrown(0.5, 0, 1);
  motion.setVelocities(thrown.replicate(sheet.mesh.points.cols(), 1));
  base::ExecutionContext context;
  for (int i = 0; i < 10; ++i) {
    const MacroState state = motion.step(context);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
  }
  const Vector3d moved = (motion.positions() - simulation->rest()).reshaped(3, sheet.mesh.points.cols()) *
                         simulation->masses() / simulation->masses().sum();
  const Vector3d expected = thrown * 0.1 + Vector3d(0, 0, -gravity) * 1e-4 * 55;
  QVERIFY((moved - expected).norm() < 1e-6);
}

void TestMacroContact::draggedFallEndsAtItsTerminalVelocity() {
  const MacroSheet sheet = strip(0.1, 0.05, 4);
  const auto simulation = std::make_shared<const MacroSimulation>(sheet, interlock::MacroOptions{});
  const double damping = 20;
  MacroMotion motion(
      simulation, underGravity(), {}, simulation->rest(), {.timeStep = 0.05, .damping = damping, .tolerance = 1e-10});
  base::ExecutionContext context;
  for (int i = 0; i < 40; ++i) QVERIFY(motion.step(context).report.converged());
  const Vector speeds = motion.velocities().reshaped(3, sheet.mesh.points.cols()).row(2).transpose();
  QVERIFY((speeds.array() + gravity / damping).abs().maxCoeff() < 1e-6);
}

void TestMacroContact::gripsLeadWhereTheyAreWanted() {
  const MacroSheet sheet = strip(0.2, 0.05, 12);
  const auto simulation = std::make_shared<const MacroSimulation>(sheet, interlock::MacroOptions{});
  MacroGrip grip;
  grip.nodes = nodesBelow(sheet, 0.02);
  grip.path = {{0, Vector3d::Zero(), Vector3d::Zero()}, {0.2, {0, 0, 0.1}, {0, 0, 0.3}}};
  MacroMotion motion(simulation, underGravity(), {grip}, simulation->rest(), {.timeStep = 0.01, .damping = 2});
  base::ExecutionContext context;
  for (int i = 0; i < 25; ++i) {
    const MacroState state = motion.step(context);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
    QVERIFY(state.violation <= 0);
    QVERIFY(motion.gripLag() < 1e-4);
  }
  const Vector3d middle(0, 0, 0.1);  // about which the grip turned by 0.3
  const Eigen::Matrix3Xd now = motion.positions().reshaped(3, sheet.mesh.points.cols());
  const Eigen::Matrix3Xd held = now(Eigen::all, grip.nodes), rest = sheet.mesh.points(Eigen::all, grip.nodes);
  const Vector3d first = held.col(0) - held.rowwise().mean(), before = rest.col(0) - rest.rowwise().mean();
  QVERIFY((first - Eigen::AngleAxisd(0.3, Vector3d::UnitZ()) * before).norm() < 1e-4);
  QVERIFY((held.rowwise().mean() - rest.rowwise().mean() - middle).norm() < 1e-4);
}

void TestMacroContact::gripsDoNotPullBeyondLimits() {
  const MacroSheet sheet = strip(0.2, 0.05, 12);
  const auto simulation = std::make_shared<const MacroSimulation>(sheet, interlock::MacroOptions{});
  MacroLoads loads;
  loads.clamped = nodesBelow(sheet, 0.02);
  MacroGrip grip;
  grip.nodes = nodesAbove(sheet, 0.18);
  grip.path = {{0, Vector3d::Zero(), Vector3d::Zero()}, {0.1, {0.1, 0, 0}, Vector3d::Zero()}};
  MacroMotion motion(simulation, loads, {grip}, simulation->rest(), {.timeStep = 0.01, .damping = 10});
  base::ExecutionContext context;
  for (int i = 0; i < 12; ++i) {
    const MacroState state = motion.step(context);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
    QVERIFY(state.violation <= 0);
  }
  // 0.1 in all strains is a stretch of at most √1.2 along the free 0.16 m, and the grip wants half as much again.
  QVERIFY(motion.gripLag() > 0.08);
}

void TestMacroContact::foldedSheetDoesNotCrossItself() {
  const MacroSheet sheet = strip(0.2, 0.04, 24);
  const auto simulation =
      std::make_shared<const MacroSimulation>(sheet, interlock::MacroOptions{}, MacroContact{{}, 2e-3, true});
  MacroLoads loads = underGravity();
  loads.clamped = nodesBelow(sheet, 0.02);
  MacroGrip grip;
  grip.nodes = nodesAbove(sheet, 0.18);
  // Over to the clamped end and down through it.
  grip.path = {{0, Vector3d::Zero(), Vector3d::Zero()},
               {0.5, {-0.18, 0, 0.04}, {0, -3, 0}},
               {0.8, {-0.18, 0, -0.05}, {0, -3, 0}}};
  MacroMotion motion(simulation, loads, {grip}, simulation->rest(), {.timeStep = 0.02, .damping = 5});
  base::ExecutionContext context;
  double smallest = 1;
  for (int i = 0; i < 40; ++i) {
    const MacroState state = motion.step(context);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
    QVERIFY(!crossesItself(sheet, state.positions));
    QVERIFY(state.smallestGap > 0);
    smallest = std::min(smallest, state.smallestGap);
  }
  QVERIFY(smallest < 2e-3);  // they met
  QVERIFY(motion.gripLag() > 0.01);
}

void TestMacroContact::ballThatRisesLiftsTheSheet() {
  const MacroSheet sheet = disk(0.1, 5);
  mechanics::Body body = ball(0.04, {0, 0, -0.045});
  body.path = {{0, Vector3d::Zero(), Vector3d::Zero()}, {0.3, {0, 0, 0.05}, Vector3d::Zero()}};
  const auto simulation =
      std::make_shared<const MacroSimulation>(sheet, interlock::MacroOptions{}, MacroContact{{body}, gap, false});
  MacroMotion motion(simulation, underGravity(), {}, simulation->rest(), {.timeStep = 0.01, .damping = 5});
  base::ExecutionContext context;
  for (int i = 0; i < 30; ++i) {
    const MacroState state = motion.step(context);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
    const Vector3d centre = motion.bodyPoints().col(0);
    QVERIFY(smallestDistance(sheet, state.positions, centre) > 0.04);
  }
  QVERIFY(motion.bodyLag() < 1e-9);
  QVERIFY(motion.positions().reshaped(3, sheet.mesh.points.cols()).col(0).norm() > 0.03);
}

/// Implicit Euler and barriers only lose energy, but for what moves on its own.
void TestMacroContact::energyIsNeverGained() {
  const MacroSheet sheet = strip(0.2, 0.05, 12);
  const auto simulation = std::make_shared<const MacroSimulation>(
      sheet, interlock::MacroOptions{}, MacroContact{{ball(0.03, {0.15, 0, -0.08})}, gap, false});
  MacroLoads loads = underGravity();
  loads.clamped = nodesBelow(sheet, 0.02);
  MacroMotion motion(simulation, loads, {}, simulation->rest(), {.timeStep = 0.01, .tolerance = 1e-9});
  base::ExecutionContext context;
  double before = motion.energies().total();
  const double weight = gravity * simulation->masses().sum();
  for (int i = 0; i < 30; ++i) {
    QVERIFY(motion.step(context).report.converged());
    const double now = motion.energies().total();
    QVERIFY2(now <= before + 1e-9 * weight, QByteArray::number(now - before));
    before = now;
  }
  QVERIFY(before < -1e-3 * weight);
}

QTEST_APPLESS_MAIN(TestMacroContact)
#include "test_macro_contact.moc"
