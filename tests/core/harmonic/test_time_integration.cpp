#include <QTest>
#include <complex>

#include "core/base/error.hpp"
#include "core/harmonic/frequency_response.hpp"
#include "core/harmonic/method_comparison.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;
using harmonic::TimeIntegration;
using Complex = std::complex<double>;

namespace {

constexpr double pi = std::numbers::pi;

/// A mass on a spring to a shaken plate, on a line, with both kinds of damping, pushed.
struct ShakenMass {
  double stiffness = 30, mass = 0.4, massDamping = 0.5, stiffnessDamping = 0.02;

  std::shared_ptr<const Model> model() const {
    auto model = std::make_shared<Model>();
    model->dimension = 1;
    model->restPositions = vector2(0, 1);
    model->energies = {mechanics::makeSpring(1, 0, 1, 1, {{stiffness}})};
    addPointMass(*model, "mass", {1}, mass);
    model->massDamping = massDamping;
    model->stiffnessDamping = stiffnessDamping;
    model->drives = {mechanics::makeTranslation({0}, Vector::Ones(1), {{{1, 0.05, 0.3}}})};
    model->forces = {{"push", {1}, Vector::Ones(1), {{{2, 0.7, 0.2}}}}};
    model->probes = {{"mass", 1}};
    model->finish();
    return model;
  }
  /// The steady motion of the trapezoidal rule with step Δt: that of the equation itself where every d/dt has become
  /// 2i/Δt tan(kωΔt/2), which the rule makes of exp(ikωt).
  double position(double omega, int steps, double tau) const {
    double x = 1;
    for (const int k : {1, 2}) {
      const double duration = 2 * pi / (omega * steps);
      const Complex rate(0, 2 / duration * std::tan(0.5 * k * omega * duration));
      const Complex spring = stiffness * (1.0 + stiffnessDamping * rate);
      const Complex load = k == 1 ? spring * std::polar(0.05, 0.3) : std::polar(0.7, 0.2);
      x += std::real(load / (mass * rate * (rate + massDamping) + spring) * std::polar(1.0, k * tau));
    }
    return x;
  }
};

harmonic::TimeIntegrationOptions options(int steps, double tolerance, int acceleration = 0) {
  return {steps, 3000, tolerance, acceleration};
}

std::shared_ptr<const Model> turnedStrip(mechanics::MassMatrix mass) {
  StripOptions options{4, 1, 1e7, 1e-3, mass, 0, true};
  const geometry::SurfaceMesh mesh = stripMesh(options);
  auto model = strip(options, mesh);
  model->massDamping = 4;
  model->stiffnessDamping = 2e-3;
  model->gravity = vector3(0, 0, -9.81);
  model->drives = {
      mechanics::makeRotation(clampedNodes(mesh, 0.026), vector3(0, 0, 0), Eigen::Vector3d::UnitY(), sine(0.35))};
  const int last = static_cast<int>(mesh.points.cols()) - 1;
  addPointMass(*model, "tip", {last}, 1e-4);
  model->probes = {{"tip", last}};
  model->finish();
  return model;
}

}  // namespace

/// Newmark's method against closed forms, and harmonic balance against Newmark's method.
class TestTimeIntegration : public QObject {
  Q_OBJECT

 private slots:
  void linearMotionIsThatOfTheRule();
  void freeSwingKeepsItsEnergy();
  void duffingAgreesWithHarmonicBalance();
  void extrapolationFindsTheSameMotion();
  void shootingFindsUnstableMotionsAndTheirMultipliers();
  void shootingIsForSmallModels();
  void shellAgreesWithHarmonicBalance_data();
  void shellAgreesWithHarmonicBalance();
  void comparisonShowsBothErrors();
  void endsWithAReason();
};

void TestTimeIntegration::linearMotionIsThatOfTheRule() {
  const ShakenMass system;
  const HarmonicBalanceProblem problem(system.model(), {1, 16});
  base::ExecutionContext context;
  for (const int steps : {16, 64}) {
    const TimeIntegration found = harmonic::integrateToPeriodicity(problem, 5, options(steps, 1e-12), context);
    QVERIFY2(found.report.converged(), found.report.message.c_str());
    for (int i = 0; i < steps; ++i) {
      const double expected = system.position(5, steps, 2 * pi * i / steps);
      QVERIFY2(std::abs(found.positions(i, 1) - expected) < 1e-10, qPrintable(QString::number(i)));
      QVERIFY(std::abs(found.positions(i, 0) - 0.05 * std::cos(2 * pi * i / steps + 0.3)) < 1e-14);
    }
    QVERIFY(found.periods.size() > 3);
    for (const harmonic::PeriodRecord& record : found.periods) QVERIFY(!record.extrapolated);
    // Transients die like exp(-ζω₀t) from one period to the next.
    const auto& p = found.periods;
    QVERIFY(p[p.size() - 1].difference < p[p.size() - 2].difference);
  }
}

/// The trapezoidal rule keeps ½ v² + ½ ω₀² x² of a linear oscillator, and turns it by 2 atan(ω₀ Δt/2) a step.
void TestTimeIntegration::freeSwingKeepsItsEnergy() {
  auto model = std::make_shared<Model>();
  model->dimension = 1;
  model->restPositions = Vector::Zero(1);
  model->energies = {mechanics::makeGroundedSpring(1, 0, Vector::Zero(1), Vector::Ones(1), {{9}})};
  addPointMass(*model, "mass", {0}, 1);
  model->finish();
  const HarmonicBalanceProblem problem(model, {1, 16});
  harmonic::NewmarkIntegration newmark(problem, 3, 20);
  newmark.start(Vector::Constant(1, 0.1), Vector::Zero(1));
  const double turn = 2 * std::atan(0.5 * 2 * pi / 20);
  for (int step = 1; step <= 1000; ++step) {
    QVERIFY(newmark.advance());
    QVERIFY(std::abs(newmark.positions()[0] - 0.1 * std::cos(step * turn)) < 1e-12 * step);
    QVERIFY(std::abs(newmark.velocities()[0] + 0.3 * std::sin(step * turn)) < 1e-12 * step);
  }
  QVERIFY(newmark.factorizations() <= 2);
}

void TestTimeIntegration::duffingAgreesWithHarmonicBalance() {
  HarmonicBalanceProblem problem(duffing(0.05, 0.8, 0.3), {21, 128});
  base::ExecutionContext context;
  const double omega = 0.8;
  const PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, {}, context);
  QVERIFY(motion.report.converged());
  std::vector<double> errors;
  for (const int steps : {64, 128, 256}) {
    const TimeIntegration found =
        harmonic::integrateToPeriodicity(problem, omega, options(steps, 1e-10), context, motion.z);
    QVERIFY2(found.report.converged(), found.report.message.c_str());
    double error = 0;
    for (int i = 0; i < steps; ++i)
      error =
          std::max(error, std::abs(found.positions(i, 0) - problem.configurationAt(motion.z, 2 * pi * i / steps)[0]));
    errors.push_back(error);
  }
  for (int i : {0, 1}) {
    const double order = std::log2(errors[i] / errors[i + 1]);
    QVERIFY2(order > 1.9 && order < 2.1, qPrintable(QString("%1 %2").arg(errors[i]).arg(errors[i + 1])));
  }
}

void TestTimeIntegration::extrapolationFindsTheSameMotion() {
  const HarmonicBalanceProblem problem(duffing(0.005, 0.8, 0.05), {1, 16});
  base::ExecutionContext context;
  const TimeIntegration plain = harmonic::integrateToPeriodicity(problem, 0.7, options(64, 1e-9), context);
  const TimeIntegration quick = harmonic::integrateToPeriodicity(problem, 0.7, options(64, 1e-9, 10), context);
  QVERIFY2(plain.report.converged() && quick.report.converged(), quick.report.message.c_str());
  QVERIFY((plain.positions - quick.positions).cwiseAbs().maxCoeff() < 1e-6 * plain.swing);
  QVERIFY2(3 * quick.periods.size() < plain.periods.size(), qPrintable(QString::number(quick.periods.size())));
  QVERIFY(!quick.periods.back().extrapolated);
}

void TestTimeIntegration::shootingFindsUnstableMotionsAndTheirMultipliers() {
  base::ExecutionContext context;
  const double zeta = 0.05;
  HarmonicBalanceProblem problem(duffing(zeta, 0.5, 0.3), {15, 64});
  harmonic::FrequencyResponseOptions curve;
  curve.from = 0.8;
  curve.to = 2.2;
  const auto response = harmonic::traceFrequencyResponse(problem, curve, context);
  int checked = 0;
  for (const harmonic::ResponsePoint& point : response.points) {
    if (point.kind != harmonic::PointKind::regular) continue;
    const bool unstable = point.stability.state == harmonic::StabilityState::unstable;
    if (!unstable && checked % 8 != 0) continue;
    harmonic::TimeIntegrationOptions shooting = options(1024, 1e-10);
    shooting.shooting = true;
    const TimeIntegration found = harmonic::integrateToPeriodicity(problem, point.omega, shooting, context, point.z);
    QVERIFY2(found.report.converged(), found.report.message.c_str());
    // Its error and that of the multipliers are those of the rule, of the second order in the step.
    const double duration = 2 * pi / 1024;
    for (int i = 0; i < 1024; i += 64) {
      const double expected = problem.configurationAt(point.z, 2 * pi * i / 1024)[0];
      QVERIFY(std::abs(found.positions(i, 0) - expected) < 30 * duration * duration * found.swing);
    }
    QCOMPARE(found.multipliers.size(), 2U);
    QCOMPARE(std::abs(found.multipliers.front()) > 1, unstable);
    // Liouville: the phase space shrinks by exp(-2 ζ T), which the trapezoidal rule turns into this product.
    const double step = 2 * pi / point.omega / 1024;
    double shrinking = 1;
    for (int i = 0; i < 1024; ++i) {
      const double x = found.positions(i, 0);
      const double curved = 0.25 * step * step * (1 + 3 * 0.5 * x * x);
      shrinking *= (1 - zeta * step + curved) / (1 + zeta * step + curved);
    }
    QVERIFY(std::abs(shrinking - std::exp(-2 * zeta * 2 * pi / point.omega)) < 1e-4 * shrinking);
    const double product = std::real(found.multipliers[0] * found.multipliers[1]);
    // As exact as central differences over a ten-thousandth of the swing.
    QVERIFY2(std::abs(product - shrinking) < 1e-6 * shrinking, qPrintable(QString::number(product / shrinking - 1)));
    QVERIFY(std::abs(std::abs(found.multipliers[0]) - std::abs(point.stability.multipliers[0])) <
            1e-3 * std::abs(found.multipliers[0]));
    checked += 1;
  }
  QVERIFY(checked > 5);
}

void TestTimeIntegration::shootingIsForSmallModels() {
  StripOptions large;
  large.lengthCells = 200;
  const geometry::SurfaceMesh mesh = stripMesh(large);
  auto model = strip(large, mesh);
  model->finish();
  const HarmonicBalanceProblem problem(model, {1, 8});
  base::ExecutionContext context;
  harmonic::TimeIntegrationOptions shooting = options(16, 1e-6);
  shooting.shooting = true;
  QVERIFY_EXCEPTION_THROWN(harmonic::integrateToPeriodicity(problem, 1, shooting, context), base::InputError);
}

void TestTimeIntegration::shellAgreesWithHarmonicBalance_data() {
  QTest::addColumn<int>("mass");
  QTest::newRow("lumped") << static_cast<int>(mechanics::MassMatrix::lumped);
  QTest::newRow("consistent") << static_cast<int>(mechanics::MassMatrix::consistent);
}

void TestTimeIntegration::shellAgreesWithHarmonicBalance() {
  QFETCH(int, mass);
  const auto model = turnedStrip(static_cast<mechanics::MassMatrix>(mass));
  const double omega = 14;
  HarmonicBalanceProblem problem(model, {14, 96});
  base::ExecutionContext context;
  const PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, {}, context);
  QVERIFY2(motion.report.converged(), motion.report.message.c_str());
  const int node = model->probes[0].node;
  const Matrix path = problem.nodeTrajectory(motion.z, node);
  double swing = 0;
  for (Eigen::Index i = 0; i < path.rows(); ++i) swing = std::max(swing, (path.row(i) - path.row(0)).norm());

  // From rest until the transient has died away; the error of the rule is of second order in the step.
  std::vector<double> errors;
  for (const int steps : {128, 256}) {
    const TimeIntegration found = harmonic::integrateToPeriodicity(problem, omega, options(steps, 1e-6), context);
    QVERIFY2(found.report.converged(), found.report.message.c_str());
    double error = 0;
    for (int i = 0; i < steps; ++i) {
      const Vector expected = problem.configurationAt(motion.z, 2 * pi * i / steps);
      error = std::max(error, (found.positions.row(i).transpose() - expected).segment(3 * node, 3).norm());
    }
    errors.push_back(error / swing);
  }
  QVERIFY2(errors[0] < 1e-2, qPrintable(QString::number(errors[0])));
  const double order = std::log2(errors[0] / errors[1]);
  QVERIFY2(order > 1.8 && order < 2.2, qPrintable(QString("%1 %2").arg(errors[0]).arg(errors[1])));
}

/// Few harmonics are off by what they leave out, Newmark by the step squared; against the extrapolated reference both
/// errors fall on and on.
void TestTimeIntegration::comparisonShowsBothErrors() {
  harmonic::MethodComparisonOptions comparison;
  comparison.harmonics = {1, 3, 5, 7, 15};
  comparison.steps = {64, 128, 256};
  comparison.samplesHarmonics = 15;
  comparison.integration = options(0, 1e-10, 10);
  base::ExecutionContext context;
  const harmonic::MethodComparison found = harmonic::compareMethods(duffing(0.05, 0.8, 0.3), 0.8, comparison, context);
  QVERIFY2(found.report.converged(), found.report.message.c_str());
  QCOMPARE(found.solutions.size(), std::size_t(5 + 3 + 3));
  for (int i = 0; i + 1 < 4; ++i) QVERIFY(found.solutions[i + 1].toReference < 0.2 * found.solutions[i].toReference);
  QVERIFY(found.solutions[4].toReference < 0.02 * found.solutions[7].toReference);
  QVERIFY(found.solutions[4].toNewmark > 0.5 * found.solutions[7].toReference);  // the error of Newmark itself
  for (const int first : {5, 8})
    for (int i = first; i < first + 2; ++i) {
      const double ratio = (first == 5 ? found.solutions[i].toReference : found.solutions[i].toNewmark) /
                           (first == 5 ? found.solutions[i + 1].toReference : found.solutions[i + 1].toNewmark);
      QVERIFY2(ratio > 3 && ratio < 4.5, qPrintable(QString("%1: %2").arg(i).arg(ratio)));
    }
}

void TestTimeIntegration::endsWithAReason() {
  const HarmonicBalanceProblem problem(duffing(0.005, 0.8, 0.05), {1, 16});
  base::ExecutionContext context;
  const TimeIntegration some =
      harmonic::integrateToPeriodicity(problem, 0.7, {.stepsPerPeriod = 32, .maximumPeriods = 3}, context);
  QVERIFY(some.report.termination == base::TerminationType::iterationLimit);
  QCOMPARE(some.periods.size(), std::size_t(3));
  QCOMPARE(some.positions.rows(), Eigen::Index(32));
  QVERIFY_EXCEPTION_THROWN(
      harmonic::integrateToPeriodicity(problem, 0.7, {.stepsPerPeriod = 4}, context), base::InputError);
  context.requestCancel();
  const TimeIntegration none = harmonic::integrateToPeriodicity(problem, 0.7, {}, context);
  QVERIFY(none.report.termination == base::TerminationType::cancelled);
}

QTEST_GUILESS_MAIN(TestTimeIntegration)
#include "test_time_integration.moc"
