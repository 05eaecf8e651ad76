#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/hexagon_mesh.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/interlock/macro_motion.hpp"

using namespace pliant;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using interlock::MacroContact;
using interlock::MacroLoads;
using interlock::MacroMaterial;
using interlock::MacroMotion;
using interlock::MacroSheet;
using interlock::MacroSimulation;
using interlock::MacroState;
using mechanics::Vector;

namespace {

constexpr double gravity = 9.81, gap = 1e-3, friction = 0.4;
/// How fast contacts creep that hold, see MacroMotion.
constexpr double creepRate = 1e-3;

MacroSheet disk(double radius, int rings) {
  MacroSheet sheet;
  sheet.mesh = geometry::makeDisk(radius, rings);
  sheet.materials = {MacroMaterial{}};
  return sheet;
}

mechanics::Body ground(const Eigen::Matrix3d& turn) {
  mechanics::Body body;
  body.points.resize(3, 4);
  body.points << -30, 30, 30, -30, -30, -30, 30, 30, 0, 0, 0, 0;
  body.points = (turn * body.points).eval();
  body.triangles = {{0, 1, 2}, {0, 2, 3}};
  return body;
}

double sizeOf(const MacroSheet& sheet) {
  return (sheet.mesh.points.rowwise().maxCoeff() - sheet.mesh.points.rowwise().minCoeff()).norm();
}

/// A disk on a plane whose slope is such that gravity pulls `share` times as hard as friction can hold.
struct Slope {
  double angle;
  Eigen::Matrix3d turn;
  MacroSheet sheet = disk(0.1, 4);
  std::shared_ptr<const MacroSimulation> simulation;
  Vector start;
  Vector3d down;

  explicit Slope(double share) : angle(std::atan(share * friction)) {
    turn = (Eigen::AngleAxisd(0.7, Vector3d::UnitZ()) * Eigen::AngleAxisd(angle, Vector3d::UnitY())).matrix();
    down = turn * Vector3d::UnitX();
    simulation = std::make_shared<const MacroSimulation>(
        sheet, interlock::MacroOptions{}, MacroContact{{ground(turn)}, gap, false, friction});
    // What presses it on the plane alone, without friction, so that nothing bounces.
    const MacroSimulation pressed(sheet, {}, {{ground(turn)}, gap, false});
    MacroLoads loads;
    loads.gravity = -gravity * std::cos(angle) * turn.col(2);
    start = (turn * (sheet.mesh.points.colwise() + Vector3d(0, 0, 0.5 * gap))).reshaped();
    base::ExecutionContext context;
    start = pressed.equilibrium(loads, &start, context).positions;
  }

  MacroLoads loads() const {
    MacroLoads loads;
    loads.gravity = {0, 0, -gravity};
    return loads;
  }
  /// Of the mean, weighted with masses.
  double along(const Vector& places) const {
    return down.dot(places.reshaped(3, sheet.mesh.points.cols()) * simulation->masses()) / simulation->masses().sum();
  }
};

/// A strip around a cylinder along y, without weight, loaded at both its ends.
struct Strip {
  MacroState state;
  double slid;  ///< of its more loaded end, over the strip's length
};

Strip strip(double ratio) {
  const double radius = 0.05, hanging = 0.05, width = 0.02;
  const double length = std::numbers::pi * (radius + 0.5 * gap) + 2 * hanging;
  const int cells = 60;
  MacroSheet sheet;
  sheet.mesh = geometry::makeGrid(length, width, cells, 2);
  MacroMaterial material;
  material.youngModulus = 3e7;
  material.thickness = 5e-4;
  sheet.materials = {material};
  mechanics::Body cylinder;
  cylinder.points.resize(3, 2);
  cylinder.points << 0, 0, -1, 1, 0, 0;
  cylinder.edges = {{0, 1}};
  cylinder.radius = radius;
  const MacroSimulation simulation(sheet, {}, {{cylinder}, gap, false, friction});
  Matrix3Xd start = sheet.mesh.points;
  MacroLoads loads;
  loads.force = Vector::Zero(start.size());
  const double tension = 0.5, wrapped = radius + 0.5 * gap;
  std::vector<int> first, last;
  for (int node = 0; node < start.cols(); ++node) {
    const double along = start(0, node) - hanging, angle = along / wrapped;
    if (along < 0)
      start.col(node) << -wrapped, start(1, node), along;
    else if (angle > std::numbers::pi)
      start.col(node) << wrapped, start(1, node), std::numbers::pi * wrapped - along;
    else
      start.col(node) << -wrapped * std::cos(angle), start(1, node), wrapped * std::sin(angle);
    if (along < -hanging + 1e-9) first.push_back(node);
    if (along > length - hanging - 1e-9) last.push_back(node);
  }
  for (const int node : first) loads.force[3 * node + 2] = -tension / static_cast<double>(first.size());
  for (const int node : last) loads.force[3 * node + 2] = -ratio * tension / static_cast<double>(last.size());
  const Vector from = start.reshaped();
  base::ExecutionContext context;
  Strip result{simulation.equilibrium(loads, &from, context), 0};
  result.slid = (from[3 * last[0] + 2] - result.state.positions[3 * last[0] + 2]) / length;
  return result;
}

}  // namespace

class TestSheetFriction : public QObject {
  Q_OBJECT

 private slots:
  void holdsOnASlopeThatIsNotTooSteep();
  void slidesDownASteeperOne();
  void equilibriumHoldsOrSlides();
  void ropeAroundACylinderHoldsTheRatioOfEuler();
  void thrownSheetStopsWhereItsEnergyIsSpent();
  void floorThatMovesTakesItAlong();
  void frictionGainsNoEnergy();
  void badCoefficientsAreRefused();
};

void TestSheetFriction::holdsOnASlopeThatIsNotTooSteep() {
  const Slope slope(0.98);
  MacroMotion motion(slope.simulation, slope.loads(), {}, slope.start, {.timeStep = 0.02});
  base::ExecutionContext context;
  for (int i = 0; i < 25; ++i) {
    const MacroState state = motion.step(context);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
  }
  const double moved = slope.along(motion.positions()) - slope.along(slope.start);
  // As fast as the law of creep needs for 0.98 of the largest force: share (2 - share) = 0.98.
  const double share = 1 - std::sqrt(0.02), expected = share * creepRate * sizeOf(slope.sheet) * motion.time();
  QVERIFY2(std::abs(moved - expected) < 0.05 * expected, QByteArray::number(moved / expected));
}

void TestSheetFriction::slidesDownASteeperOne() {
  const Slope slope(1.02);
  MacroMotion motion(slope.simulation, slope.loads(), {}, slope.start, {.timeStep = 0.02});
  base::ExecutionContext context;
  std::vector<double> speeds;
  for (int i = 0; i < 25; ++i) {
    const MacroState state = motion.step(context);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
    speeds.push_back(slope.along(motion.velocities()));
    if (i > 2) QCOMPARE(state.friction.slidingShare, 1.0);
  }
  const double expected = gravity * (std::sin(slope.angle) - friction * std::cos(slope.angle));
  const double found = (speeds[24] - speeds[4]) / (20 * 0.02);
  QVERIFY2(std::abs(found - expected) < 0.01 * expected, QByteArray::number(found / expected));
}

void TestSheetFriction::equilibriumHoldsOrSlides() {
  const Slope holding(0.98);
  base::ExecutionContext context;
  const MacroState state = holding.simulation->equilibrium(holding.loads(), &holding.start, context);
  QVERIFY2(state.report.converged(), state.report.message.c_str());
  QCOMPARE(state.friction.slidingShare, 0.0);
  QVERIFY(state.friction.lag < 0.02);
  QVERIFY(std::abs(holding.along(state.positions) - holding.along(holding.start)) < 0.01 * sizeOf(holding.sheet));
  const Slope sliding(1.02);
  const MacroState slid = sliding.simulation->equilibrium(sliding.loads(), &sliding.start, context);
  QVERIFY(slid.report.termination == base::TerminationType::iterationLimit);
  QVERIFY(QByteArray(slid.report.message.c_str()).contains("still slides"));
}

/// Euler and Eytelwein: ends hold as long as their forces' ratio is below e^(μ angle).
void TestSheetFriction::ropeAroundACylinderHoldsTheRatioOfEuler() {
  const double ratio = std::exp(friction * std::numbers::pi);
  const Strip held = strip(0.95 * ratio);
  QVERIFY2(held.state.report.converged(), held.state.report.message.c_str());
  QCOMPARE(held.state.friction.slidingShare, 0.0);
  QVERIFY2(held.slid < 0.02, QByteArray::number(held.slid));
  const Strip slid = strip(1.05 * ratio);
  QVERIFY(!slid.state.report.converged());
  QVERIFY2(slid.slid > 0.2, QByteArray::number(slid.slid));
}

void TestSheetFriction::thrownSheetStopsWhereItsEnergyIsSpent() {
  const Slope flat(0);
  const double h = 0.01, speed = 0.5;
  MacroMotion motion(flat.simulation, flat.loads(), {}, flat.start, {.timeStep = h});
  motion.setVelocities((speed * flat.down).replicate(flat.sheet.mesh.points.cols(), 1));
  base::ExecutionContext context;
  const double before = motion.energies().total();
  const int steps = static_cast<int>(std::ceil(speed / (friction * gravity * h))) + 2;
  for (int i = 0; i < steps; ++i) QVERIFY(motion.step(context).report.converged());
  // Σ h (v - μ g h i), the sum of implicit Euler, is v²/(2 μ g) - v h/2 where it ends at speed 0.
  const double slowed = friction * gravity * h;
  double expected = 0;
  for (double v = speed - slowed; v > 0; v -= slowed) expected += h * v;
  const double moved = flat.along(motion.positions()) - flat.along(flat.start);
  QVERIFY2(std::abs(moved - expected) < 0.01 * expected, QByteArray::number(moved / expected));
  // What it had, less what Euler's scheme loses: ½ m (Δv)² a step.
  const double mass = flat.simulation->masses().sum();
  const double scheme = 0.5 * mass * slowed * speed;
  const double spent = motion.energies().dissipated, lost = before - motion.energies().total();
  QVERIFY2(std::abs(spent + scheme - lost) < 0.01 * lost, QByteArray::number((spent + scheme) / lost));
}

void TestSheetFriction::floorThatMovesTakesItAlong() {
  const Slope flat(0);
  mechanics::Body floor = ground(flat.turn);
  const double acceleration = 0.5 * friction * gravity, h = 0.01;
  for (int i = 0; i <= 20; ++i) {
    const double time = i * h;
    floor.path.push_back({time, 0.5 * acceleration * time * time * flat.down, Vector3d::Zero()});
  }
  const auto simulation = std::make_shared<const MacroSimulation>(
      flat.sheet, interlock::MacroOptions{}, MacroContact{{floor}, gap, false, friction});
  MacroMotion motion(simulation, flat.loads(), {}, flat.start, {.timeStep = h});
  base::ExecutionContext context;
  for (int i = 0; i < 20; ++i) QVERIFY(motion.step(context).report.converged());
  const double moved = flat.along(motion.positions()) - flat.along(flat.start), led = 0.5 * acceleration * 0.04;
  QVERIFY2(moved < led && moved > 0.98 * led, QByteArray::number(moved / led));
}

void TestSheetFriction::frictionGainsNoEnergy() {
  const Slope slope(0.3);
  MacroMotion motion(slope.simulation, slope.loads(), {}, slope.start, {.timeStep = 0.01, .tolerance = 1e-9});
  // Thrown uphill and aside, and turning.
  Vector velocities(slope.start.size());
  const Vector3d middle = slope.start.reshaped(3, slope.sheet.mesh.points.cols()).rowwise().mean();
  for (Eigen::Index node = 0; node < slope.sheet.mesh.points.cols(); ++node)
    velocities.segment<3>(3 * node) = slope.turn * Vector3d(-0.3, 0.2, 0) +
                                      3 * slope.turn.col(2).cross(Vector3d(slope.start.segment<3>(3 * node) - middle));
  motion.setVelocities(velocities);
  base::ExecutionContext context;
  interlock::MacroEnergies before = motion.energies();
  const double first = before.kinetic;
  for (int i = 0; i < 25; ++i) {
    const MacroState state = motion.step(context);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
    const interlock::MacroEnergies now = motion.energies();
    QVERIFY(now.dissipated >= before.dissipated);
    const double gained = now.total() + now.dissipated - before.total() - before.dissipated;
    QVERIFY2(gained <= 1e-6 * first, QByteArray::number(gained / first));
    before = now;
  }
  QVERIFY(before.kinetic < 1e-3 * first);
  QVERIFY(before.dissipated > 0.5 * first);
}

void TestSheetFriction::badCoefficientsAreRefused() {
  QVERIFY_THROWS_EXCEPTION(base::InputError, MacroSimulation(disk(0.1, 2), {}, MacroContact{{}, gap, true, -1}));
}

QTEST_APPLESS_MAIN(TestSheetFriction)
#include "test_sheet_friction.moc"
