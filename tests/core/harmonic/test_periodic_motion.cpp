#include <QRegularExpression>
#include <QTest>

#include "core/harmonic/amplitude.hpp"
#include "core/harmonic/periodic_motion.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using base::TerminationType;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;

namespace {

/// A strip of foil on a shaken foot. Thinner than `StripOptions` has it, it is a thousand times stiffer in its plane
/// than against bending.
std::shared_ptr<const Model> shakenStrip(double amplitude, bool bending) {
  StripOptions options;
  options.bending = bending;
  options.thickness = 2e-4;
  options.youngModulus = 3e9;
  const geometry::SurfaceMesh mesh = stripMesh(options);
  auto model = strip(options, mesh);
  model->massDamping = 0.5;
  model->stiffnessDamping = 5e-5;
  model->drives = {mechanics::makeTranslation(clampedNodes(mesh, 0.02), vector3(0, 0, 1), sine(amplitude))};
  model->probes = {{"tip", static_cast<int>(mesh.points.cols()) - 1}};
  model->finish();
  return model;
}

PeriodicMotion solve(const HarmonicBalanceProblem& from, double omega, const Vector& start = {}) {
  HarmonicBalanceProblem problem = from;
  base::ExecutionContext context;
  return harmonic::solvePeriodicMotion(problem, omega, {}, context, start);
}

}  // namespace

class TestPeriodicMotion : public QObject {
  Q_OBJECT

 private slots:
  void newtonConvergesQuadratically();
  void startsFromTheStaticStateUnderGravity();
  void rampsTheDriveWhereNewtonFails();
  void flatMembraneIsRefused();
  void freeBodyIsRefused();
  void cancellation();
  void driveIsRestored();
  void moreHarmonicsUntilNothingChanges();
  void harmonicsMayNotSuffice();
};

void TestPeriodicMotion::newtonConvergesQuadratically() {
  const HarmonicBalanceProblem problem(shakenStrip(5e-3, true), {5, 64});
  const PeriodicMotion motion = solve(problem, 40);
  QVERIFY(motion.report.converged());
  const auto& records = motion.report.iterations;
  QVERIFY(records.size() <= 10);
  // The order of convergence of the last steps before rounding: log-ratios of successive residuals.
  double order = 0;
  for (std::size_t k = 2; k < records.size(); ++k)
    order = std::max(order, std::log(records[k].residual / records[k - 1].residual) /
                                std::log(records[k - 1].residual / records[k - 2].residual));
  QVERIFY2(order > 1.7, qPrintable(QString::number(order)));
  // The tip bends: its motion is not the foot's.
  QVERIFY(harmonic::amplitude(problem, motion.z, problem.model().probes[0].node).pathLength > 0.03);
}

void TestPeriodicMotion::startsFromTheStaticStateUnderGravity() {
  // Without a drive, the motion is rest in the sagged state, where the tip hangs lower than the small-strain estimate
  // of a cantilever would have it rise, and every node is in equilibrium.
  auto model = std::make_shared<Model>(*shakenStrip(0, true));
  model->gravity = vector3(0, 0, -9.81);
  model->finish();
  const HarmonicBalanceProblem problem(model, {2, 12});
  const PeriodicMotion motion = solve(problem, 40);
  QVERIFY(motion.report.converged());
  QVERIFY(problem.oscillation(motion.z).norm() < 1e-9);
  const Vector positions = problem.configurationAt(motion.z, 0.3);
  const Vector force = problem.assembler().gradient(positions) - model->externalForce(0);
  const Vector unbalanced = force(model->dofs.freeCoordinates);
  QVERIFY(unbalanced.norm() < 1e-8 * model->externalForce(0).norm());
  // A cantilever under its own weight hangs by ρ h g L⁴ / (8 D); the hinges of short cells have D to D/2, and the
  // lumped masses lie farther out.
  const double plate = 3e9 * std::pow(2e-4, 3) / 12;
  const double sag = -positions[3 * model->probes[0].node + 2];
  const double beam = 1200 * 2e-4 * 9.81 * std::pow(0.1 - 0.1 / 6, 4) / (8 * plate);
  QVERIFY2(sag > 0.8 * beam && sag < 2.4 * beam, qPrintable(QString("%1 %2").arg(sag).arg(beam)));
}

void TestPeriodicMotion::rampsTheDriveWhereNewtonFails() {
  // A pendulum on a stiff link whose foot turns by 100 degrees: the linear response stretches the link grossly.
  auto model = std::make_shared<Model>();
  model->dimension = 2;
  model->restPositions = Eigen::Vector4d(0, 0, 0, -1);
  model->gravity = vector2(0, -9.81);
  model->lockedCoordinates = {0, 0, 0, 0};
  addPointMass(*model, "bob", {1}, 1);
  model->energies = {mechanics::makeSpring(2, 0, 1, 1, {{1e5}})};
  model->massDamping = 0.3;
  model->drives = {mechanics::makeTranslation({0}, vector2(1, 0), sine(0.5))};
  model->probes = {{"bob", 1}};
  model->finish();
  const HarmonicBalanceProblem problem(model, {9, 64});
  const PeriodicMotion motion = solve(problem, 3);
  QVERIFY2(motion.report.converged(), motion.report.message.c_str());
  QVERIFY(problem.residual(motion.z, 3).norm() <= 1e-8 * problem.forceScale(3));
  // The link keeps its length.
  const Matrix path = problem.trajectories(motion.z);
  for (Eigen::Index i = 0; i < path.rows(); ++i)
    QVERIFY(std::abs((path.row(i).tail<2>() - path.row(i).head<2>()).norm() - 1) < 1e-2);
  // It swings more than the foot.
  QVERIFY(harmonic::amplitude(problem, motion.z, 1).pathLength > 4 * 0.5);
}

void TestPeriodicMotion::flatMembraneIsRefused() {
  const PeriodicMotion motion = solve(HarmonicBalanceProblem(shakenStrip(1e-3, false), {3, 16}), 20);
  QVERIFY(motion.report.termination == base::TerminationType::failed);
  const QString message = QString::fromStdString(motion.report.message);
  QVERIFY2(message.contains(QRegularExpression("node \\d+ along z")) && message.contains("lock"), qPrintable(message));
}

void TestPeriodicMotion::freeBodyIsRefused() {
  auto model = std::make_shared<Model>(*shakenStrip(1e-3, true));
  model->drives.clear();
  model->forces = {{"force", {3}, vector3(0, 0, 1), cosine(1e-3)}};
  model->finish();
  const PeriodicMotion motion = solve(HarmonicBalanceProblem(model, {3, 16}), 20);
  QVERIFY(motion.report.termination == base::TerminationType::failed);
  QVERIFY2(motion.report.message.find("Nothing holds") != std::string::npos, motion.report.message.c_str());
}

void TestPeriodicMotion::cancellation() {
  HarmonicBalanceProblem problem(shakenStrip(5e-3, true), {5, 64});
  base::ExecutionContext context;
  context.requestCancel();
  const PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, 40, {}, context);
  QVERIFY(motion.report.termination == base::TerminationType::cancelled);
  QVERIFY(!motion.report.message.empty());
}

void TestPeriodicMotion::driveIsRestored() {
  HarmonicBalanceProblem problem(shakenStrip(5e-3, true), {3, 16});
  base::ExecutionContext context;
  harmonic::solvePeriodicMotion(problem, 40, {}, context);
  QCOMPARE(problem.driveFraction(), 1.0);
}

void TestPeriodicMotion::moreHarmonicsUntilNothingChanges() {
  base::ExecutionContext context;
  const auto model = duffing(0.05, 0.5, 0.5);
  const auto [problem, motion] =
      harmonic::solveWithAdaptiveHarmonics(HarmonicBalanceProblem(model, {1, 8}), 0.9, 1e-4, 31, {}, context);
  QVERIFY(motion.report.converged());
  QVERIFY(problem.basis().harmonics() > 3 && problem.basis().harmonics() < 31);
  QVERIFY(problem.basis().samples() >= 4 * problem.basis().harmonics() + 1);
  // Against many harmonics.
  const HarmonicBalanceProblem reference(model, {31, 256});
  const PeriodicMotion exact =
      solve(reference, 0.9, HarmonicBalanceProblem::changeHarmonics(motion.z, problem.basis().harmonics(), 31));
  const double length = harmonic::amplitude(reference, exact.z, 0).pathLength;
  for (int i = 0; i < 50; ++i) {
    const double tau = 0.13 * i;
    QVERIFY((problem.configurationAt(motion.z, tau) - reference.configurationAt(exact.z, tau)).norm() < 1e-4 * length);
  }
}

void TestPeriodicMotion::harmonicsMayNotSuffice() {
  base::ExecutionContext context;
  const auto [problem, motion] = harmonic::solveWithAdaptiveHarmonics(
      HarmonicBalanceProblem(duffing(0.05, 0.5, 0.5), {1, 8}), 0.9, 1e-12, 4, {}, context);
  QVERIFY(motion.report.termination == base::TerminationType::iterationLimit);
  QCOMPARE(problem.basis().harmonics(), 4);
  QCOMPARE(motion.z.size(), problem.size());
}

QTEST_GUILESS_MAIN(TestPeriodicMotion)
#include "test_periodic_motion.moc"
