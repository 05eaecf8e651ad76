#include <QTest>

#include "tests/core/cloth/cloth_examples.hpp"

using namespace pliant;
using cloth::ClothSimulation;
using cloth::SteppingScheme;

namespace {

/// The state of a problem after `duration`, by the classical Runge-Kutta method with small steps.
Eigen::Matrix3Xd rungeKutta(const cloth::ClothProblem& problem, Eigen::Matrix3Xd positions, Eigen::Matrix3Xd velocities,
                            double duration, int steps) {
  const mechanics::ElasticAssembler assembler(problem.model);
  const Eigen::VectorXd masses = cloth::lumpedMasses(*problem.model);
  const mechanics::Vector force = problem.model->externalForce(0);
  const auto held = cloth::lockedNodes(*problem.model);
  const auto acceleration = [&](const Eigen::Matrix3Xd& x) {
    Eigen::Matrix3Xd result = (force - assembler.gradient(x.reshaped())).reshaped(3, x.cols());
    for (Eigen::Index node = 0; node < x.cols(); ++node)
      result.col(node) *= held[static_cast<std::size_t>(node)] ? 0 : 1 / masses[node];
    return result;
  };
  const double h = duration / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Matrix3Xd a1 = acceleration(positions), v2 = velocities + h / 2 * a1;
    const Eigen::Matrix3Xd a2 = acceleration(positions + h / 2 * velocities), v3 = velocities + h / 2 * a2;
    const Eigen::Matrix3Xd a3 = acceleration(positions + h / 2 * v2), v4 = velocities + h * a3;
    const Eigen::Matrix3Xd a4 = acceleration(positions + h * v3);
    positions += h / 6 * (velocities + 2 * v2 + 2 * v3 + v4);
    velocities += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return positions;
}

/// Keeps every free node within a distance of where its sheet has its origin: bobs on tethers, to which the closest
/// point is known.
class TetherLimiter final : public cloth::StrainLimiter {
 public:
  explicit TetherLimiter(double length) : length_(length) {}
  std::string_view name() const override { return "tether"; }
  solvers::ConeSolution project(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd&,
                                base::ExecutionContext&) override {
    solvers::ConeSolution solution;
    solution.positions = candidate;
    for (Eigen::Index node = 0; node < candidate.cols(); ++node)
      if (const double distance = candidate.col(node).norm(); distance > length_)
        solution.positions.col(node) *= length_ / distance;
    solution.report.termination = base::TerminationType::converged;
    return solution;
  }

 private:
  double length_;
};

constexpr double tether = 1, startAngle = 0.9, startRate = 0.7, gravity = 9.81;

Eigen::Vector3d bobAt(double angle) { return {tether * std::sin(angle), 0, -tether * std::cos(angle)}; }
Eigen::Vector3d bobVelocity(double angle, double rate) {
  return {tether * rate * std::cos(angle), 0, tether * rate * std::sin(angle)};
}

/// Three bobs without anything between them, in a sheet that has a limit so that the limiter is asked.
cloth::ClothProblem bobs() {
  auto model = std::make_shared<mechanics::Model>();
  model->restPositions.resize(9);
  model->restPositions << bobAt(startAngle), 0, 0.5, 0, 0.5, 0, 0;
  model->pointMasses = {{"bobs", {0, 1, 2}, 0.1, 0, 1}};
  model->gravity = Eigen::Vector3d(0, 0, -gravity);
  model->finish();
  cloth::ClothProblem problem;
  problem.sheet.nodeCount = 3;
  problem.sheet.triangles = {{{0, 1, 2}, {Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}, 0}};
  problem.sheet.limits = {cloth::IsotropicLimit{1e6}};
  problem.sheet.constraints = {cloth::exactConstraints(problem.sheet.limits.front())};
  problem.sheet.masses = cloth::lumpedMasses(*model);
  problem.sheet.fixed = {0, 0, 0};
  problem.model = std::move(model);
  return problem;
}

/// The angle of a pendulum after `duration`, by the classical Runge-Kutta method.
double pendulumAngle(double duration) {
  double angle = startAngle, rate = startRate;
  constexpr int steps = 4000;
  const double h = duration / steps;
  const auto pull = [](double at) { return -gravity / tether * std::sin(at); };
  for (int i = 0; i < steps; ++i) {
    const double a1 = pull(angle), r2 = rate + h / 2 * a1, a2 = pull(angle + h / 2 * rate), r3 = rate + h / 2 * a2;
    const double a3 = pull(angle + h / 2 * r2), r4 = rate + h * a3, a4 = pull(angle + h * r3);
    angle += h / 6 * (rate + 2 * r2 + 2 * r3 + r4);
    rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return angle;
}

ClothSimulation pendulum(SteppingScheme scheme, double timeStep) {
  cloth::SteppingOptions options;
  options.scheme = scheme;
  options.timeStep = timeStep;
  ClothSimulation simulation(std::make_shared<const cloth::ClothProblem>(bobs()), options,
                             [](const cloth::SheetCones&) { return std::make_unique<TetherLimiter>(tether); });
  Eigen::Matrix3Xd velocities = Eigen::Matrix3Xd::Zero(3, 3);
  velocities.col(0) = bobVelocity(startAngle, startRate);
  simulation.setState(0, simulation.state().positions, velocities);
  return simulation;
}

/// Distance of the bob from where it belongs after a second.
double pendulumError(SteppingScheme scheme, int steps) {
  ClothSimulation simulation = pendulum(scheme, 1.0 / steps);
  base::ExecutionContext context;
  for (int i = 0; i < steps; ++i) simulation.step(context);
  return (simulation.state().positions.col(0) - bobAt(pendulumAngle(1))).norm();
}

/// Energy lost by the bob in ten seconds of hundredths, relative to the most it can have as motion.
double pendulumLoss(SteppingScheme scheme) {
  ClothSimulation simulation = pendulum(scheme, 0.01);
  const auto energy = [&] {
    return 0.5 * simulation.state().velocities.col(0).squaredNorm() + gravity * simulation.state().positions(2, 0);
  };
  const double before = energy();
  base::ExecutionContext context;
  for (int i = 0; i < 1000; ++i) simulation.step(context);
  return (before - energy()) / (before + gravity * tether);
}

}  // namespace

class TestSteppingSchemes : public QObject {
  Q_OBJECT

 private slots:
  void convergenceOrderWithoutLimits_data() {
    QTest::addColumn<int>("scheme");
    QTest::addColumn<double>("order");
    QTest::addRow("implicit Euler") << int(SteppingScheme::implicitEuler) << 1.0;
    QTest::addRow("step and reflect") << int(SteppingScheme::stepAndReflect) << 1.0;
    QTest::addRow("BDF-2") << int(SteppingScheme::bdf2) << 2.0;
    QTest::addRow("BDF-2 over half steps") << int(SteppingScheme::bdf2AndReflect) << 2.0;
    QTest::addRow("midpoint") << int(SteppingScheme::secondOrderReflect) << 2.0;
  }
  void convergenceOrderWithoutLimits() {
    QFETCH(int, scheme);
    QFETCH(double, order);
    const auto problem = test::withModel(test::sheetProblem(2), [](mechanics::Model& model) {
      model.gravity = Eigen::Vector3d(0, 0, -9.81);
      for (const int node : {0, 3, 6})
        for (int axis = 0; axis < 3; ++axis) model.lockedCoordinates[3 * node + axis] = 1;
    });
    const Eigen::Matrix3Xd start = problem.model->restPositions.reshaped(3, 9);
    Eigen::Matrix3Xd velocities = Eigen::Matrix3Xd::Zero(3, 9);
    velocities.row(2) = 2 * start.row(0);  // a smooth swing
    constexpr double duration = 0.1;
    const Eigen::Matrix3Xd expected = rungeKutta(problem, start, velocities, duration, 2000);
    std::vector<double> errors;
    for (const int steps : {40, 80, 160}) {
      ClothSimulation simulation = test::simulate(problem, static_cast<SteppingScheme>(scheme), duration / steps);
      simulation.setState(0, start, velocities);
      base::ExecutionContext context;
      for (int i = 0; i < steps; ++i) simulation.step(context);
      errors.push_back((simulation.state().positions - expected).norm());
    }
    for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
      const double found = std::log2(errors[i] / errors[i + 1]);
      QVERIFY2(std::abs(found - order) < 0.2, qPrintable(QString("order %1, error %2").arg(found).arg(errors[i])));
    }
  }

  void convergenceOrderAlongALimit_data() {
    QTest::addColumn<int>("scheme");
    QTest::addColumn<double>("order");
    QTest::addRow("step and project") << int(SteppingScheme::stepAndProject) << 1.0;
    QTest::addRow("step and reflect") << int(SteppingScheme::stepAndReflect) << 1.0;
    QTest::addRow("BDF-2 and project") << int(SteppingScheme::bdf2AndProject) << 2.0;
    QTest::addRow("BDF-2 and reflect") << int(SteppingScheme::bdf2AndReflect) << 1.0;
    QTest::addRow("midpoint") << int(SteppingScheme::secondOrderReflect) << 1.0;
  }
  void convergenceOrderAlongALimit() {
    QFETCH(int, scheme);
    QFETCH(double, order);
    const auto error = [&](int steps) { return pendulumError(static_cast<SteppingScheme>(scheme), steps); };
    const double coarse = error(200), middle = error(400), fine = error(800);
    for (const double found : {std::log2(coarse / middle), std::log2(middle / fine)})
      QVERIFY2(std::abs(found - order) < 0.2, qPrintable(QString("order %1, error %2").arg(found).arg(coarse)));
  }

  /// Thesis Fig. 3.4: reflection loses less energy than projection, BDF-2 less than Euler. A pendulum that never leaves
  /// its tether is where reflection helps least.
  void energyLossAlongALimit() {
    const double project = pendulumLoss(SteppingScheme::stepAndProject);
    const double reflect = pendulumLoss(SteppingScheme::stepAndReflect);
    const double midpoint = pendulumLoss(SteppingScheme::secondOrderReflect);
    const double bdf2 = pendulumLoss(SteppingScheme::bdf2AndProject);
    QVERIFY2(project > reflect && reflect > 0,
             qPrintable(QString("%1, %2, %3, %4").arg(project).arg(reflect).arg(midpoint).arg(bdf2)));
    QVERIFY(midpoint > 0 && 5 * midpoint < reflect);
    QVERIFY(std::abs(bdf2) < 0.02 * project);
  }

  void limitsAreKeptByTheSchemesThatKeepThem() {
    for (const auto scheme :
         {SteppingScheme::stepAndProject, SteppingScheme::stepAndReflect, SteppingScheme::bdf2AndProject,
          SteppingScheme::bdf2AndReflect, SteppingScheme::secondOrderReflect}) {
      ClothSimulation simulation = pendulum(scheme, 0.01);
      base::ExecutionContext context;
      for (int i = 0; i < 50; ++i) simulation.step(context);
      QVERIFY(simulation.state().positions.colwise().norm().maxCoeff() <= tether * (1 + 1e-14));
    }
    ClothSimulation simulation = pendulum(SteppingScheme::implicitEuler, 0.01);
    base::ExecutionContext context;
    for (int i = 0; i < 50; ++i) simulation.step(context);
    QVERIFY(simulation.state().positions.colwise().norm().maxCoeff() > 1.1 * tether);
  }
};

QTEST_GUILESS_MAIN(TestSteppingSchemes)
#include "test_stepping_schemes.moc"
