#include <QTest>

#include "core/harmonic/periodic_motion.hpp"
#include "core/harmonic/response_sensitivity.hpp"
#include "core/harmonic/time_integration.hpp"
#include "core/mechanics/family_parameter.hpp"
#include "tests/core/harmonic/example_models.hpp"
#include "tests/core/harmonic/oscillator_oracle.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;

namespace {

constexpr double zeta = 0.05, gamma = 0.8, low = 0.35, high = 0.25, phase = 0.7;
constexpr double omega = 0.45;  ///< the drives are at twice and three times this
constexpr int harmonics = 41;

/// x'' + 2 ζ x' + x + γ x³ = P cos 2ωt + Q cos(3ωt + φ): two drives whose frequencies are as 2 to 3.
std::shared_ptr<Model> twoTones(double p, double q) {
  auto model = std::make_shared<Model>(*duffing(zeta, gamma, 0));
  model->forces = {{"low", {0}, vector2(1, 0), {{{2, p, 0}}}}, {"high", {0}, vector2(1, 0), {{{3, q, phase}}}}};
  model->familyValues = {p, q};
  model->finish();
  return model;
}

/// With the mass and both amplitudes as parameters.
std::shared_ptr<const Model> example() {
  auto model = twoTones(low, high);
  const auto family = std::make_shared<const mechanics::ModelFamily>(
      [](const std::vector<double>& values) { return *twoTones(values[0], values[1]); });
  model->parameters.push_back(mechanics::makeFamilyParameter(0, {"low", "/low", base::dimensions::none, 0, 1}, family));
  model->parameters.push_back(
      mechanics::makeFamilyParameter(1, {"high", "/high", base::dimensions::none, 0, 1}, family));
  return model;
}

PeriodicMotion solve(std::shared_ptr<const Model> model, const Vector& start = {}) {
  HarmonicBalanceProblem problem(std::move(model), {harmonics, 256});
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions options;
  options.tolerance = options.stepTolerance = 1e-13;
  PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, options, context, start);
  if (!motion.report.converged()) QTest::qFail("there is no motion", __FILE__, __LINE__);
  return motion;
}

OscillatorOracle oracle() {
  OscillatorOracle result;
  result.damping = 2 * zeta;
  result.force = [](const Eigen::VectorXd& x) -> Eigen::VectorXd { return x.array() + gamma * x.array().cube(); };
  result.stiffness = [](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
    return Eigen::VectorXd(1 + 3 * gamma * x.array().square()).asDiagonal();
  };
  result.drive = [](double tau) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, low * std::cos(2 * tau) + high * std::cos(3 * tau + phase));
  };
  return result;
}

}  // namespace

/// Drives at multiples of one frequency: what they do together repeats with that one.
class TestSeveralFrequencies : public QObject {
  Q_OBJECT

 private slots:
  void agreesWithRungeKutta();
  void combinationsOfTheFrequenciesAppear();
  void newmarksMethodConvergesToIt();
  void sensitivitiesAgreeWithDifferences();
};

void TestSeveralFrequencies::agreesWithRungeKutta() {
  const PeriodicMotion motion = solve(example());
  const Eigen::VectorXd start = startOfSeries(motion.z, harmonics, omega);
  const Eigen::VectorXd orbit = oracle().orbit(start, omega);
  QVERIFY2((start - orbit).norm() < 1e-6 * orbit.norm(), qPrintable(QString::number((start - orbit).norm())));
  QVERIFY(oracle().unstableCount(orbit, omega) == 0);
}

/// The cubic spring makes 2·2 - 3 = 1, 2·3 - 2 = 4 and so on of them, none of which is driven.
void TestSeveralFrequencies::combinationsOfTheFrequenciesAppear() {
  const Vector z = solve(example()).z;
  const auto amplitude = [&](int order) { return std::hypot(z[2 * order - 1], z[2 * order]); };
  const double largest = std::max(amplitude(2), amplitude(3));
  for (const int order : {1, 4, 6, 7, 8, 9}) QVERIFY(amplitude(order) > 1e-4 * largest);
  // One of the drives alone repeats faster.
  const Vector alone = solve(twoTones(low, 0)).z;
  for (const int order : {1, 3, 5}) QVERIFY(std::hypot(alone[2 * order - 1], alone[2 * order]) < 1e-10);
}

void TestSeveralFrequencies::newmarksMethodConvergesToIt() {
  const PeriodicMotion motion = solve(example());
  const HarmonicBalanceProblem problem(example(), {harmonics, 256});
  double before = 0;
  for (const int steps : {192, 384, 768}) {
    harmonic::TimeIntegrationOptions options;
    options.stepsPerPeriod = steps;
    options.shooting = true;
    options.tolerance = 1e-11;
    base::ExecutionContext context;
    const auto integration = harmonic::integrateToPeriodicity(problem, omega, options, context, motion.z);
    QVERIFY2(integration.report.converged(), integration.report.message.c_str());
    const math::HarmonicBasis basis(harmonics, steps);
    const double error = (basis.synthesis() * motion.z - integration.positions.col(0)).norm() / std::sqrt(steps);
    if (before > 0) QVERIFY2(std::abs(std::log2(before / error) - 2) < 0.1, qPrintable(QString::number(error)));
    before = error;
  }
  QVERIFY(before < 1e-3);
}

void TestSeveralFrequencies::sensitivitiesAgreeWithDifferences() {
  const auto model = example();
  const PeriodicMotion motion = solve(model);
  const harmonic::ResponseSensitivity sensitivity(HarmonicBalanceProblem(model, {harmonics, 256}), motion);
  for (std::size_t p = 0; p < 3; ++p) {
    const auto& parameter = *model->parameters[p];
    const double step = 1e-3;
    const auto at = [&](double change) {
      return solve(
                 std::make_shared<const Model>(parameter.withValue(*model, parameter.value(*model) + change)), motion.z)
          .z;
    };
    const Vector difference = (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
    const double error =
        (sensitivity.derivative().col(static_cast<Eigen::Index>(p)) - difference).norm() / difference.norm();
    QVERIFY2(error < 1e-6, qPrintable(QString::number(error)));
  }
}

QTEST_GUILESS_MAIN(TestSeveralFrequencies)
#include "test_several_frequencies.moc"
