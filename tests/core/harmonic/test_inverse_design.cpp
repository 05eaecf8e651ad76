#include <QTest>

#include "core/base/error.hpp"
#include "core/harmonic/inverse_design.hpp"
#include "core/harmonic/path_length.hpp"
#include "core/mechanics/registry.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::DesignIterate;
using harmonic::HarmonicBalanceProblem;
using harmonic::InverseDesignOptions;
using harmonic::InverseDesignResult;

namespace {

constexpr double springStiffness = 1, alpha = 0.1, force = 0.1, omega = 1.2;

/// m x'' + α m x' + x = F cos ωt: amplitude F / |1 - m ω² + iαmω|, its path four times as long, and longest for
/// m = 1 / (ω² + α²).
std::shared_ptr<Model> oscillator(double mass, double cubic = 0) {
  auto model = std::make_shared<Model>(*duffing(alpha / 2, cubic, force));
  model->pointMasses[0] = {"mass", {0}, mass, 0.2, 3};
  return model;
}

double pathLengthOf(double mass) {
  return 4 * force / std::hypot(springStiffness - mass * omega * omega, alpha * mass * omega);
}

InverseDesignOptions options() {
  InverseDesignOptions result;
  result.omega = omega;
  result.parameters = {0};
  result.motion.tolerance = 1e-12;
  result.optimizer.gradientTolerance = 1e-9;
  result.optimizer.valueTolerance = 1e-14;
  return result;
}

InverseDesignResult design(const std::shared_ptr<const Model>& model, const harmonic::DesignObjective& objective,
                           const InverseDesignOptions& chosen = options()) {
  base::ExecutionContext context;
  return harmonic::designInversely(HarmonicBalanceProblem(model, {7, 64}), objective, chosen, context);
}

void compare(double found, double expected, double relative) {
  if (!(std::abs(found - expected) <= relative * std::abs(expected)))
    QTest::qFail(
        qPrintable(QString("%1, expected %2").arg(found, 0, 'g', 12).arg(expected, 0, 'g', 12)), __FILE__, __LINE__);
}

}  // namespace

class TestInverseDesign : public QObject {
  Q_OBJECT

 private slots:
  void tunesToResonance();
  void reachesTheWantedAmplitude();
  void staysWithinBounds();
  void findsTheDesignOfAPath_data();
  void findsTheDesignOfAPath();
  void staysOnItsBranch();
  void regularizationHoldsBack();
  void reportsEveryDesign();
  void keepsTheBestWhenCancelled();
  void saysThatTheFirstDesignHasNoMotion();
};

void TestInverseDesign::tunesToResonance() {
  const InverseDesignResult result = design(oscillator(2), *harmonic::makeAmplitudeObjective({{0}, {}, {}}));
  QVERIFY2(result.report.converged(), result.report.message.c_str());
  const double best = 1 / (omega * omega + alpha * alpha);
  compare(result.history.front().amplitudes[0].pathLength, pathLengthOf(2), 1e-9);
  compare(result.history.back().values[0], best, 1e-5);
  compare(result.history.back().amplitudes[0].pathLength, pathLengthOf(best), 1e-9);
}

void TestInverseDesign::reachesTheWantedAmplitude() {
  const double wanted = 0.5;
  const InverseDesignResult result = design(oscillator(2), *harmonic::makeAmplitudeObjective({{0}, wanted, {}}));
  QVERIFY2(result.report.converged(), result.report.message.c_str());
  compare(result.history.back().amplitudes[0].pathLength, wanted, 1e-5);
  compare(pathLengthOf(result.history.back().values[0]), wanted, 1e-5);
}

void TestInverseDesign::staysWithinBounds() {
  auto model = oscillator(2);
  model->pointMasses[0].minimum = 1;
  const InverseDesignResult result = design(model, *harmonic::makeAmplitudeObjective({{0}, {}, {}}));
  QVERIFY2(result.report.converged(), result.report.message.c_str());
  QCOMPARE(result.history.back().values[0], 1.0);
}

void TestInverseDesign::findsTheDesignOfAPath_data() {
  QTest::addColumn<int>("kind");
  for (std::size_t i = 0; i < mechanics::parameterKinds().size(); ++i)
    QTest::newRow(mechanics::parameterKinds()[i].name.c_str()) << static_cast<int>(i);
}

/// Another design's path, begun at another time, leads back to that design.
void TestInverseDesign::findsTheDesignOfAPath() {
  QFETCH(int, kind);
  std::mt19937 random(12);
  const Model model = mechanics::parameterKinds()[static_cast<std::size_t>(kind)].drivenExample(random);
  const auto& parameter = *model.parameters[0];
  const double wanted = 1.15 * parameter.value(model);
  HarmonicBalanceProblem other(std::make_shared<const Model>(parameter.withValue(model, wanted)), {5, 32});
  base::ExecutionContext context;
  const auto motion = harmonic::solvePeriodicMotion(other, 3, {}, context);
  QVERIFY(motion.report.converged());
  harmonic::PathGoal goal;
  goal.phases = 4096;
  goal.sharpness = 1e7;
  goal.paths = {{2, harmonic::nodeCoefficients(other, motion.z, 2)}};
  for (int k = 1; k <= 5; k += 2) goal.paths[0].coefficients.middleRows(2 * k - 1, 2) *= -1;  // half a period later
  InverseDesignOptions chosen = options();
  chosen.omega = 3;
  base::ExecutionContext run;
  const InverseDesignResult result =
      harmonic::designInversely(HarmonicBalanceProblem(std::make_shared<const Model>(model), {5, 32}),
                                *harmonic::makePathObjective(goal), chosen, run);
  QVERIFY(!result.history.empty());
  compare(result.history.back().values[0], wanted, 1e-3);
  QVERIFY(result.history.back().objective < 1e-4 * result.history.front().objective);
}

/// A hardening oscillator has three motions at some masses. From the small one, the designs must be connected by small
/// changes of the mass, each followed by plain Newton iterations.
void TestInverseDesign::staysOnItsBranch() {
  const auto model = oscillator(1.6, 4);
  InverseDesignOptions chosen = options();
  chosen.optimizer.firstStep = 0.5;
  const InverseDesignResult result = design(model, *harmonic::makeAmplitudeObjective({{0}, {}, {}}), chosen);
  QVERIFY(result.history.size() > 1);
  Vector z = result.history.front().z;
  for (std::size_t i = 1; i < result.history.size(); ++i) {
    const DesignIterate &from = result.history[i - 1], &to = result.history[i];
    QVERIFY(to.objective < from.objective);
    constexpr int steps = 50;
    for (int step = 1; step <= steps; ++step) {
      const double mass = from.values[0] + (to.values[0] - from.values[0]) * step / steps;
      HarmonicBalanceProblem problem(oscillator(mass, 4), {7, 64});
      base::ExecutionContext context;
      const auto motion = harmonic::solvePeriodicMotion(problem, omega, {}, context, z);
      QVERIFY(motion.report.converged());
      z = motion.z;
    }
    QVERIFY((z - to.z).norm() < 1e-2 * z.norm());  // other branches are several times as far
  }
}

/// f = (A - wanted)² + w ((m - m₀) / range)²: where its derivative vanishes, from the closed form of A.
void TestInverseDesign::regularizationHoldsBack() {
  const double wanted = 0.5, weight = 0.05, start = 2, range = 2.8;
  const auto objective =
      harmonic::makeWeightedSum({{1, harmonic::makeAmplitudeObjective({{0}, wanted, {}})},
                                 {weight, harmonic::makeParameterRegularization({0}, Vector::Constant(1, start))}});
  const InverseDesignResult result = design(oscillator(start), *objective);
  QVERIFY2(result.report.converged(), result.report.message.c_str());
  const double mass = result.history.back().values[0], step = 1e-5;
  QVERIFY(mass < start && pathLengthOf(mass) < 0.99 * wanted);
  const double slope = (pathLengthOf(mass + step) - pathLengthOf(mass - step)) / (2 * step);
  const double pull = 2 * (pathLengthOf(mass) - wanted) * slope, hold = 2 * weight * (mass - start) / (range * range);
  compare(pull, -hold, 1e-3);
}

void TestInverseDesign::reportsEveryDesign() {
  base::ExecutionContext context;
  std::vector<DesignIterate> seen;
  const auto objective = harmonic::makeAmplitudeObjective({{0}, {}, {}});
  const InverseDesignResult result =
      harmonic::designInversely(HarmonicBalanceProblem(oscillator(2), {7, 64}), *objective, options(), context,
                                [&](const DesignIterate& design) { seen.push_back(design); });
  QCOMPARE(seen.size(), result.history.size());
  QCOMPARE(seen.size(), result.report.iterations.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    QCOMPARE(seen[i].iteration, static_cast<int>(i));
    QCOMPARE(seen[i].model->pointMasses[0].mass, seen[i].values[0]);
    const HarmonicBalanceProblem problem(seen[i].model, {7, 64});
    QVERIFY(problem.residual(seen[i].z, omega).norm() < 1e-9 * problem.forceScale(omega));
    QCOMPARE(seen[i].amplitudes[0].pathLength, -seen[i].objective);
    compare(seen[i].amplitudes[0].pathLength, pathLengthOf(seen[i].values[0]), 1e-8);
  }
  QCOMPARE(context.progress() > 0, true);
}

void TestInverseDesign::keepsTheBestWhenCancelled() {
  base::ExecutionContext context;
  const auto objective = harmonic::makeAmplitudeObjective({{0}, {}, {}});
  const InverseDesignResult result = harmonic::designInversely(
      HarmonicBalanceProblem(oscillator(2), {7, 64}), *objective, options(), context, [&](const DesignIterate& design) {
        if (design.iteration == 2) context.requestCancel();
      });
  QVERIFY(result.report.termination == base::TerminationType::cancelled);
  QCOMPARE(result.history.size(), std::size_t(3));
  QVERIFY(result.history[2].objective < result.history[0].objective);
}

void TestInverseDesign::saysThatTheFirstDesignHasNoMotion() {
  InverseDesignOptions chosen = options();
  chosen.motion.maximumIterations = 1;
  chosen.motion.maximumRampSteps = 1;
  const InverseDesignResult result =
      design(oscillator(1, 1e6), *harmonic::makeAmplitudeObjective({{0}, {}, {}}), chosen);
  QVERIFY(!result.report.converged() && !result.report.message.empty());
  QVERIFY(result.history.empty());
}

QTEST_GUILESS_MAIN(TestInverseDesign)
#include "test_inverse_design.moc"
