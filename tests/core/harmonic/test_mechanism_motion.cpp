#include <QTest>

#include "core/harmonic/periodic_motion.hpp"
#include "tests/core/harmonic/example_models.hpp"
#include "tests/core/mechanics/double_pendulum.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;
using mechanics::DoublePendulum;

namespace {

/// Its pivot is shaken so that the links swing by more than a right angle to and fro.
const DoublePendulum pendulum{
    .length = {0.6, 0.4}, .mass = {1.5, 1}, .gravity = 9.81, .damping = 0.6, .swing = 0.25, .omega = 3.0};

std::shared_ptr<const Model> drivenPendulum(double stiffness) {
  Model model = pendulum.model(stiffness);
  model.lockedCoordinates.assign(6, 0);
  model.drives.push_back(mechanics::makeTranslation({0}, vector2(1, 0), cosine(pendulum.swing)));
  model.finish();
  return std::make_shared<const Model>(model);
}

PeriodicMotion solve(HarmonicBalanceProblem& problem) {
  base::ExecutionContext context;
  return harmonic::solvePeriodicMotion(problem, pendulum.omega, {}, context);
}

}  // namespace

/// Rigid links under harmonic balance.
class TestMechanismMotion : public QObject {
  Q_OBJECT

 private slots:
  void doublePendulumSwingsAsItsEquationSays();
  void violationFallsWithStiffness();
};

void TestMechanismMotion::doublePendulumSwingsAsItsEquationSays() {
  // The steady motion of the equation in the angles, after its transients have died out.
  const double period = 2 * std::numbers::pi / pendulum.omega;
  constexpr int periods = 40, steps = 400;
  DoublePendulum::State state = DoublePendulum::State::Zero(), before = state;
  const auto advance = [&](int step) {
    state = mechanics::rungeKutta(pendulum, state, step * period / steps, period / steps);
  };
  for (int i = 0; i < periods; ++i) {
    before = state;
    for (int step = 0; step < steps; ++step) advance(step);
  }
  QVERIFY((state - before).norm() <= 1e-6);

  HarmonicBalanceProblem problem(drivenPendulum(1e7), math::HarmonicBasis(16, 100));
  const PeriodicMotion motion = solve(problem);
  QVERIFY2(motion.report.converged(), motion.report.message.c_str());
  double deviation = 0, largest = 0;
  for (int step = 0; step < steps; ++step) {
    const double tau = 2 * std::numbers::pi * step / steps;
    const Vector expected = pendulum.positions(state, step * period / steps);
    deviation = std::max(deviation, (problem.configurationAt(motion.z, tau) - expected).norm());
    largest = std::max(largest, std::abs(state[1]));
    advance(step);
  }
  qInfo("lower link swings by %.0f degrees; largest deviation %.1e m; %zu Newton iterations", largest * 180 / M_PI,
        deviation, motion.report.iterations.size());
  QVERIFY(largest > 0.5 * std::numbers::pi / 2);
  QVERIFY(deviation <= 1e-4);
}

void TestMechanismMotion::violationFallsWithStiffness() {
  std::vector<double> violations;
  for (const double stiffness : {1e5, 1e6, 1e7}) {
    HarmonicBalanceProblem problem(drivenPendulum(stiffness), math::HarmonicBasis(16, 100));
    const PeriodicMotion motion = solve(problem);
    QVERIFY2(motion.report.converged(), motion.report.message.c_str());
    const Matrix positions = problem.trajectories(motion.z);
    double largest = 0;
    for (Eigen::Index i = 0; i < positions.rows(); ++i)
      largest = std::max(largest, *mechanics::constraintViolation(problem.model(), positions.row(i)));
    qInfo("stiffness %.0e N: largest violation %.1e, %zu iterations", stiffness, largest,
          motion.report.iterations.size());
    violations.push_back(largest);
  }
  QVERIFY(std::abs(std::log10(violations[0] / violations[1]) - 1) <= 0.15);
  QVERIFY(violations[2] <= 2e-5);  // thesis 2.5.5
}

QTEST_GUILESS_MAIN(TestMechanismMotion)
#include "test_mechanism_motion.moc"
