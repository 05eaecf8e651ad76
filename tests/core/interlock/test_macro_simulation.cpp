#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/interlock/macro_simulation.hpp"
#include "core/mechanics/shell.hpp"
#include "core/solvers/static_equilibrium.hpp"
#include "tests/core/mechanics/strain_set_examples.hpp"

using namespace pliant;
using Eigen::Vector3d;
using interlock::MacroLoads;
using interlock::MacroMaterial;
using interlock::MacroOptions;
using interlock::MacroSheet;
using interlock::MacroSimulation;
using interlock::MacroState;
using mechanics::Vector;

namespace {

constexpr double length = 0.1, width = 0.05;

/// A strip from x = 0 to `length`.
MacroSheet strip(int cells, const MacroMaterial& material) {
  MacroSheet sheet;
  sheet.mesh = geometry::makeGrid(length, width, cells, cells / 2);
  sheet.materials = {material};
  return sheet;
}

std::shared_ptr<const mechanics::AdmissibleStrainSet> ball(double radius) {
  return mechanics::strainSet([radius](const Vector3d&) { return radius; });
}

/// Forces along an edge that are in balance with a homogeneous stress.
void addEdgeForce(const MacroSheet& sheet, const std::string& edge, const Vector3d& force, Vector& forces) {
  const auto& nodes = sheet.mesh.groups.at(edge);
  for (const int node : nodes) {
    const bool isCorner = std::abs(std::abs(sheet.mesh.points(1, node)) - width / 2) < 1e-9;
    forces.segment<3>(3 * Eigen::Index{node}) += (isCorner ? 0.5 : 1.0) / (nodes.size() - 1.0) * force;
  }
}

MacroState equilibriumOf(const MacroSheet& sheet, const MacroLoads& loads, const MacroOptions& options = {}) {
  base::ExecutionContext context;
  return MacroSimulation(sheet, options).equilibrium(loads, nullptr, context);
}

/// Held at its first two rows of nodes: a single one would be a hinge.
MacroLoads clampedAtStart(const MacroSheet& sheet) {
  MacroLoads loads;
  for (int node = 0; node < sheet.mesh.points.cols(); ++node)
    if (sheet.mesh.points(0, node) < 0.3 * length) loads.clamped.push_back(node);
  loads.force = Vector::Zero(sheet.mesh.points.size());
  return loads;
}

}  // namespace

class TestMacroSimulation : public QObject {
  Q_OBJECT

 private slots:
  void withoutLimitsItIsAnElasticShell();
  void pulledStripReachesTheSetsFarthestStretch();
  void strengthOfThePullDoesNotMatter();
  void curvatureStaysWithinItsLimit();
  void penaltyAgreesWithTheBarrier();
  void turnedMaterialTurnsTheLimits();
  void marginShrinksTheSetAboutItsMiddle();
  void marginKeepsTheShapeAtRest();
  void badInputIsRefused_data();
  void badInputIsRefused();
};

/// Against the solver of static equilibria of scenes, which factorises by LU.
void TestMacroSimulation::withoutLimitsItIsAnElasticShell() {
  MacroMaterial material;
  material.youngModulus = 1e6;
  const MacroSheet sheet = strip(8, material);
  MacroLoads loads = clampedAtStart(sheet);
  loads.gravity = {0, 0, -9.81};
  const MacroState state = equilibriumOf(sheet, loads);
  QVERIFY(state.report.converged());

  mechanics::Model model;
  model.restPositions = sheet.mesh.points.reshaped();
  const mechanics::ShellMaterial shell{
      material.youngModulus, material.poissonRatio, material.density, material.thickness};
  model.energies = {mechanics::makeMembrane(3, model.restPositions, sheet.mesh.triangles, shell),
                    mechanics::makeHingeBending(model.restPositions, sheet.mesh.triangles, shell)};
  model.lockedCoordinates.assign(static_cast<std::size_t>(model.coordinateCount()), 0);
  for (const int node : loads.clamped)
    for (int i = 0; i < 3; ++i) model.lockedCoordinates[3 * node + i] = 1;
  model.finish();
  const MacroSimulation simulation(sheet, {});
  Vector weight = Vector::Zero(model.coordinateCount());
  for (Eigen::Index node = 0; node < simulation.masses().size(); ++node)
    weight[3 * node + 2] = -9.81 * simulation.masses()[node];
  base::ExecutionContext context;
  const mechanics::ElasticAssembler assembler(std::make_shared<const mechanics::Model>(model));
  const solvers::StaticEquilibrium other =
      solvers::solveStaticEquilibrium(model, assembler, model.restPositions, weight, {}, context);
  QVERIFY(other.report.converged());
  const double deflection = (other.positions - model.restPositions).cwiseAbs().maxCoeff();
  QVERIFY(deflection > 0.005);
  QVERIFY((state.positions - other.positions).cwiseAbs().maxCoeff() < 1e-6 * deflection);
}

/// Of all strains in a ball of radius r, that with the largest E_x has mean and deviator r/√2: E_x = √2 r, E_y = 0.
void TestMacroSimulation::pulledStripReachesTheSetsFarthestStretch() {
  MacroMaterial material;
  material.youngModulus = 1;
  material.stretch = ball(0.1);
  const MacroSheet sheet = strip(6, material);
  MacroLoads loads;
  loads.force = Vector::Zero(sheet.mesh.points.size());
  addEdgeForce(sheet, "end", {10, 0, 0}, loads.force);
  addEdgeForce(sheet, "start", {-10, 0, 0}, loads.force);
  loads.clamped = {0};
  std::vector<double> errors;
  for (const double remaining : {1e-3, 1e-4, 1e-5}) {
    MacroOptions options;
    options.remaining = remaining;
    const MacroState state = equilibriumOf(sheet, loads, options);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
    QVERIFY(state.stretchGauge.maxCoeff() < 1);
    QCOMPARE(state.violation, 0.0);
    const Vector3d expected(0.1 / std::sqrt(2.0), 0.1 / std::sqrt(2.0), 0);
    double error = 0;
    for (Eigen::Index t = 0; t < state.strains.stretch.cols(); ++t)
      error = std::max(error, (state.strains.stretch.col(t) - expected).norm());
    errors.push_back(error);
  }
  qInfo("errors of the strain %.1e, %.1e, %.1e", errors[0], errors[1], errors[2]);
  QVERIFY(errors[2] < 0.2 * errors[1]);
  QVERIFY(errors[2] < 1e-4);
}

void TestMacroSimulation::strengthOfThePullDoesNotMatter() {
  MacroMaterial material;
  material.stretch = ball(0.1);
  material.bending = ball(20);
  const MacroSheet sheet = strip(6, material);
  std::vector<Vector> positions;
  for (const double force : {20.0, 2000.0}) {
    MacroLoads loads = clampedAtStart(sheet);
    addEdgeForce(sheet, "end", {force, 0, 0}, loads.force);
    const MacroState state = equilibriumOf(sheet, loads);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
    positions.push_back(state.positions);
  }
  QVERIFY((positions[0] - positions[1]).cwiseAbs().maxCoeff() < 1e-3 * length);
}

/// A heavy end: near the clamp the strip has the largest curvature there is, and nowhere more.
void TestMacroSimulation::curvatureStaysWithinItsLimit() {
  MacroMaterial material;
  material.stretch = ball(0.02);
  material.bending = ball(8);
  const MacroSheet sheet = strip(12, material);
  MacroLoads loads = clampedAtStart(sheet);
  addEdgeForce(sheet, "end", {0, 0, -5}, loads.force);
  const MacroState state = equilibriumOf(sheet, loads);
  QVERIFY2(state.report.converged(), state.report.message.c_str());
  QCOMPARE(state.violation, 0.0);
  qInfo("%zu iterations; largest gauge 1 - %.1e; remaining %.1e of the work", state.report.iterations.size(),
        1 - state.bendingGauge.maxCoeff(), state.remaining / state.work);
  QVERIFY(state.bendingGauge.maxCoeff() < 1);
  QVERIFY(state.bendingGauge.maxCoeff() > 0.999);
  QVERIFY(state.remaining < 1e-4 * state.work);
}

void TestMacroSimulation::penaltyAgreesWithTheBarrier() {
  MacroMaterial material;
  material.stretch = ball(0.05);
  material.bending = ball(15);
  const MacroSheet sheet = strip(8, material);
  MacroLoads loads = clampedAtStart(sheet);
  addEdgeForce(sheet, "end", {0, 0, -0.5}, loads.force);
  const MacroState barrier = equilibriumOf(sheet, loads);
  MacroOptions options;
  options.limits = mechanics::StrainLimitFunction::Kind::penalty;
  options.maximumIterations = 5000;
  const MacroState penalty = equilibriumOf(sheet, loads, options);
  QVERIFY2(barrier.report.converged(), barrier.report.message.c_str());
  QVERIFY2(penalty.report.converged(), penalty.report.message.c_str());
  const int node = sheet.mesh.groups.at("end").front();
  const double first = barrier.positions[3 * node + 2], second = penalty.positions[3 * node + 2];
  qInfo("deflections %.5f m and %.5f m; %zu and %zu iterations; violation of the penalty %.1e", first, second,
        barrier.report.iterations.size(), penalty.report.iterations.size(), penalty.violation);
  QVERIFY(penalty.violation > 0 && penalty.violation < 1e-2);
  QVERIFY(std::abs(first / second - 1) < 0.02);
}

/// A set that is long along the material's first axis, pulled along x: turned by 90 degrees it gives way less.
void TestMacroSimulation::turnedMaterialTurnsTheLimits() {
  MacroMaterial material;
  material.youngModulus = 1;
  // In (mean, deviator): far where both are above 0, the stretch of the first axis alone.
  material.stretch = mechanics::strainSet([](const Vector3d& direction) {
    return 0.05 * (1 + std::max(0.0, (direction[0] + direction[1]) / std::sqrt(2.0)));
  });
  std::vector<double> stretches;
  for (const double angle : {0.0, M_PI / 2}) {
    MacroSheet sheet = strip(4, material);
    sheet.angleOf.assign(sheet.mesh.triangles.size(), angle);
    MacroLoads loads = clampedAtStart(sheet);
    addEdgeForce(sheet, "end", {10, 0, 0}, loads.force);
    const MacroState state = equilibriumOf(sheet, loads);
    QVERIFY2(state.report.converged(), state.report.message.c_str());
    stretches.push_back(state.positions[3 * sheet.mesh.groups.at("end").front()] / length - 1);
  }
  qInfo("stretches %.4f along the first axis, %.4f across", stretches[0], stretches[1]);
  QVERIFY(stretches[0] > 1.5 * stretches[1]);
}

/// Thrown, it falls as every body does, whatever its limits are.
/// Against a set that is made smaller by hand.
void TestMacroSimulation::marginShrinksTheSetAboutItsMiddle() {
  const double margin = 0.2;
  const Vector3d middle(0.01, -0.02, 0.005);
  const auto shape = [](const Vector3d& u) { return 0.1 * (1 + 0.3 * u.x() * u.y()); };
  MacroMaterial whole, smaller;
  whole.stretch = mechanics::strainSet(shape, middle);
  smaller.stretch = mechanics::strainSet([&](const Vector3d& u) { return (1 - margin) * shape(u); }, middle);
  whole.bending = ball(50);
  smaller.bending = ball((1 - margin) * 50);
  const MacroSheet sheet = strip(8, whole);
  MacroLoads loads = clampedAtStart(sheet);
  loads.gravity = {20, 0, -9.81};
  MacroOptions options;
  options.margin = margin;
  const MacroState state = equilibriumOf(sheet, loads, options), expected = equilibriumOf(strip(8, smaller), loads);
  QVERIFY(state.report.converged() && expected.report.converged());
  QVERIFY((state.positions - expected.positions).cwiseAbs().maxCoeff() < 1e-6 * length);
  QVERIFY(state.violation <= 0);
  QVERIFY(state.stretchGauge.maxCoeff() < 1 - margin);
  QVERIFY(state.stretchGauge.maxCoeff() > 0.98 * (1 - margin));
  QVERIFY((state.stretchGauge - (1 - margin) * expected.stretchGauge).cwiseAbs().maxCoeff() < 1e-4);
}

void TestMacroSimulation::marginKeepsTheShapeAtRest() {
  MacroMaterial material;
  material.stretch = mechanics::strainSet([](const Vector3d&) { return 0.1; }, {0.07, 0, 0});
  MacroOptions options;
  options.margin = 0.29;
  const MacroSimulation allowed(strip(4, material), options);
  options.margin = 0.31;
  QVERIFY_THROWS_EXCEPTION(base::InputError, MacroSimulation(strip(4, material), options));
  options.margin = 0.1;
  options.limits = mechanics::StrainLimitFunction::Kind::penalty;
  QVERIFY_THROWS_EXCEPTION(base::InputError, MacroSimulation(strip(4, material), options));
}

void TestMacroSimulation::badInputIsRefused_data() {
  QTest::addColumn<std::string>("kind");
  for (const char* name : {"not flat", "no material", "no stiffness", "rest not allowed", "no such material"})
    QTest::newRow(name) << std::string(name);
}

void TestMacroSimulation::badInputIsRefused() {
  QFETCH(std::string, kind);
  MacroSheet sheet = strip(4, {});
  if (kind == "not flat") sheet.mesh.points(2, 3) = 0.01;
  if (kind == "no material") sheet.materials.clear();
  if (kind == "no stiffness") sheet.materials[0].youngModulus = 0;
  if (kind == "no such material") sheet.materialOf.assign(sheet.mesh.triangles.size(), 1);
  if (kind == "rest not allowed")
    sheet.materials[0].stretch = mechanics::strainSet([](const Vector3d&) { return 0.1; }, Vector3d(0.2, 0, 0));
  QVERIFY_THROWS_EXCEPTION(base::InputError, MacroSimulation(sheet, MacroOptions{}));
}

QTEST_APPLESS_MAIN(TestMacroSimulation)
#include "test_macro_simulation.moc"
