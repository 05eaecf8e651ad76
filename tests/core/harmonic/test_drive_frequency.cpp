#include <QTest>

#include "core/base/error.hpp"
#include "core/harmonic/constrained_design.hpp"
#include "core/harmonic/design_gradient.hpp"
#include "core/harmonic/design_space.hpp"
#include "core/harmonic/prediction_error.hpp"
#include "core/harmonic/response_sensitivity.hpp"
#include "core/mechanics/drive_frequency.hpp"
#include "core/mechanics/registry.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;

namespace {

std::shared_ptr<const mechanics::DesignParameter> frequency(double value, double minimum, double maximum) {
  return mechanics::makeDriveFrequency({"frequency", "/studies/0/frequency", value, minimum, maximum});
}

/// A model with everything in it, the frequency its only parameter.
std::shared_ptr<const Model> example(double omega) {
  std::mt19937 random(4);
  auto model = std::make_shared<Model>(mechanics::parameterKinds()[0].drivenExample(random));
  model->parameters = {frequency(omega, 1, 6)};
  return model;
}

HarmonicBalanceProblem problemOf(std::shared_ptr<const Model> model) { return {std::move(model), {5, 32}}; }

PeriodicMotion solve(HarmonicBalanceProblem& problem, const Vector& start = {}) {
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions options;
  options.tolerance = options.stepTolerance = 1e-13;
  const double omega = mechanics::driveFrequency(problem.model()).value();
  PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, options, context, start);
  if (!motion.report.converged()) qFatal("there is no motion");
  return motion;
}

constexpr double middle = 3;

/// Differences of order 4 of what whole solves give.
double differenceOf(const std::function<double(double)>& valueAt, double step) {
  return (8 * (valueAt(step) - valueAt(-step)) - (valueAt(2 * step) - valueAt(-2 * step))) / (12 * step);
}

}  // namespace

class TestDriveFrequency : public QObject {
  Q_OBJECT

 private slots:
  void gradientAgreesWithDifferencesOfWholeSolves_data();
  void gradientAgreesWithDifferencesOfWholeSolves();
  void predictsMotions();
  void knowsTheErrorOfPredictions();
  void designFindsTheLargestSwing();
  void designKeepsConstraints();
  void spacesHaveMotionsOfEveryFrequency();
  void modelsCarryTheirOwn();
};

void TestDriveFrequency::gradientAgreesWithDifferencesOfWholeSolves_data() {
  QTest::addColumn<int>("objectiveKind");
  QTest::addColumn<int>("constraintKind");
  for (std::size_t i = 0; i < harmonic::objectiveKinds().size(); ++i)
    QTest::newRow(harmonic::objectiveKinds()[i].name.c_str()) << static_cast<int>(i) << -1;
  for (std::size_t i = 0; i < harmonic::constraintKinds().size(); ++i)
    QTest::newRow(harmonic::constraintKinds()[i].name.c_str()) << -1 << static_cast<int>(i);
}

void TestDriveFrequency::gradientAgreesWithDifferencesOfWholeSolves() {
  QFETCH(int, objectiveKind);
  QFETCH(int, constraintKind);
  std::mt19937 random(2);
  HarmonicBalanceProblem problem = problemOf(example(middle));
  std::shared_ptr<const harmonic::DesignObjective> goal;
  if (objectiveKind >= 0)
    goal = harmonic::objectiveKinds()[static_cast<std::size_t>(objectiveKind)].example(problem, random);
  else
    goal = harmonic::constraintKinds()[static_cast<std::size_t>(constraintKind)].example(problem, random);
  const PeriodicMotion motion = solve(problem);
  const harmonic::DesignGradient gradient = harmonic::designGradient(problem, motion, *goal, {0});
  const double difference = differenceOf(
      [&](double change) {
        HarmonicBalanceProblem changed = problemOf(example(middle + change));
        return goal->evaluate(changed, solve(changed, motion.z).z).value;
      },
      1e-3);
  QVERIFY2(std::abs(gradient.gradient[0] - difference) < 1e-6 * std::abs(difference) + 1e-11,
           qPrintable(QString("%1, differences %2").arg(gradient.gradient[0], 0, 'g', 10).arg(difference, 0, 'g', 10)));
}

void TestDriveFrequency::predictsMotions() {
  HarmonicBalanceProblem problem = problemOf(example(middle));
  const PeriodicMotion motion = solve(problem);
  const harmonic::ResponseSensitivity sensitivity(problem, motion);
  QVERIFY(sensitivity.regular());
  double previous = 0;
  for (const double change : {0.02, 0.01, 0.005}) {
    HarmonicBalanceProblem changed = problemOf(example(middle + change));
    const double error =
        (solve(changed, motion.z).z - sensitivity.predict(Vector::Constant(1, change))).norm() / motion.z.norm();
    // Of second order.
    if (previous > 0) QVERIFY2(std::abs(previous / error - 4) < 0.4, qPrintable(QString::number(previous / error)));
    previous = error;
  }
}

void TestDriveFrequency::knowsTheErrorOfPredictions() {
  HarmonicBalanceProblem problem = problemOf(example(middle));
  const PeriodicMotion motion = solve(problem);
  const harmonic::ResponseSensitivity sensitivity(problem, motion);
  const harmonic::PredictionError error(problem, motion, sensitivity);
  const Vector second = error.derivatives(Vector::Ones(1), 2).second;
  const double step = 1e-3;
  const auto at = [&](double change) {
    HarmonicBalanceProblem changed = problemOf(example(middle + change));
    return solve(changed, motion.z).z;
  };
  const Vector difference = (at(step) - 2 * motion.z + at(-step)) / (step * step);
  QVERIFY2((second - difference).norm() < 1e-3 * difference.norm(),
           qPrintable(QString::number((second - difference).norm() / difference.norm())));
}

/// x'' + 2 ζ x' + x = P cos ωt swings farthest at ω² = 1 - 2 ζ².
void TestDriveFrequency::designFindsTheLargestSwing() {
  const double zeta = 0.1;
  auto model = std::make_shared<Model>(*duffing(zeta, 0, 0.1));
  model->parameters = {frequency(1.3, 0.5, 2)};
  harmonic::InverseDesignOptions options;
  options.omega = 1.3;
  options.parameters = {0};
  options.motion.tolerance = 1e-12;
  options.optimizer.gradientTolerance = 1e-8;
  options.optimizer.valueTolerance = 1e-14;
  base::ExecutionContext context;
  const auto result = harmonic::designInversely(
      HarmonicBalanceProblem(model, {3, 32}), *harmonic::makeAmplitudeObjective({{0}, {}, {}}), options, context);
  QVERIFY2(result.report.converged(), result.report.message.c_str());
  const double expected = std::sqrt(1 - 2 * zeta * zeta);
  QVERIFY(std::abs(result.history.back().values[0] - expected) < 1e-5);
  QCOMPARE(mechanics::driveFrequency(*result.history.back().model).value(), result.history.back().values[0]);
  QVERIFY(std::abs(result.history.back().amplitudes[0].maximumDisplacement -
                   0.1 / (2 * zeta * std::sqrt(1 - zeta * zeta))) < 1e-9);
}

/// The swing may be 0.3: the frequency above the resonance at which it is.
void TestDriveFrequency::designKeepsConstraints() {
  const double zeta = 0.1, force = 0.1, allowed = 0.3;
  auto model = std::make_shared<Model>(*duffing(zeta, 0, force));
  model->parameters = {frequency(1.6, 1.1, 2)};
  harmonic::InverseDesignOptions options;
  options.omega = 1.6;
  options.parameters = {0};
  options.motion.tolerance = 1e-12;
  options.optimizer.gradientTolerance = 1e-7;
  harmonic::ClearanceGoal goal{{0}, harmonic::Plane{vector2(0.5, 0), vector2(-1, 0)}, 1e5};
  harmonic::DesignConstraint wall{"wall", harmonic::makeClearance(goal)};
  wall.lower = 0.5 - allowed;
  wall.scale = 0.1;
  base::ExecutionContext context;
  const auto result =
      harmonic::designWithConstraints(HarmonicBalanceProblem(model, {3, 32}),
                                      *harmonic::makeAmplitudeObjective({{0}, {}, {}}), {wall}, options, context);
  QVERIFY2(result.design.report.converged(), result.design.report.message.c_str());
  // (1 - u)² + 4 ζ² u = (P / 0.3)², u = ω².
  const double half = 1 - 2 * zeta * zeta, ratio = force / allowed;
  const double expected = std::sqrt(half + std::sqrt(half * half - 1 + ratio * ratio));
  QVERIFY(std::abs(result.design.history.back().values[0] - expected) < 1e-3);
}

void TestDriveFrequency::spacesHaveMotionsOfEveryFrequency() {
  const double zeta = 0.1, force = 0.1;
  auto model = std::make_shared<Model>(*duffing(zeta, 0, force));
  model->parameters = {frequency(1.3, 0.5, 2)};
  harmonic::DesignSpaceOptions options;
  options.omega = 1.3;
  options.parameters = {0};
  options.count = 10;
  base::ExecutionContext context;
  const harmonic::DesignSpace space =
      harmonic::sampleDesignSpace(HarmonicBalanceProblem(model, {3, 32}), options, context);
  QVERIFY(space.report.converged());
  for (const harmonic::SampledDesign& design : space.designs) {
    const double omega = design.values[0];
    const double expected = force / std::hypot(1 - omega * omega, 2 * zeta * omega);
    QVERIFY(std::abs(design.amplitudes[0].maximumDisplacement - expected) < 1e-7);
  }
}

void TestDriveFrequency::modelsCarryTheirOwn() {
  const auto model = example(middle);
  const auto& parameter = *model->parameters[0];
  const Model changed = parameter.withValue(*model, 2);
  QCOMPARE(parameter.value(changed), 2.0);
  QCOMPARE(parameter.value(*model), middle);
  QCOMPARE(mechanics::driveFrequency(changed).value(), 2.0);
  QVERIFY(!mechanics::driveFrequency(*duffing(0.1, 0, 0.1)));
  QCOMPARE(mechanics::withoutDriveFrequencies(model, [](const std::string&) { return true; }), model);
  QVERIFY(mechanics::withoutDriveFrequencies(model, [](const std::string& pointer) {
            return pointer == "/studies/1/frequency";
          })->parameters.empty());
  try {
    parameter.withValue(*model, 0);
    QFAIL("nothing was refused");
  } catch (const base::InputError& error) {
    QVERIFY(!error.problem().empty());
  }
}

QTEST_GUILESS_MAIN(TestDriveFrequency)
#include "test_drive_frequency.moc"
