#include <Eigen/Eigenvalues>
#include <QTest>

#include "core/harmonic/frequency_response.hpp"
#include "tests/core/harmonic/example_models.hpp"
#include "tests/core/harmonic/oscillator_oracle.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::FrequencyResponse;
using harmonic::HarmonicBalanceProblem;
using harmonic::PointKind;
using harmonic::ResponsePoint;
using harmonic::Stability;
using harmonic::StabilityState;

namespace {

constexpr int harmonics = 9;

FrequencyResponse trace(const std::shared_ptr<const Model>& model, double from, double to) {
  HarmonicBalanceProblem problem(model, {harmonics, 64});
  base::ExecutionContext context;
  harmonic::FrequencyResponseOptions options;
  options.from = from;
  options.to = to;
  return harmonic::traceFrequencyResponse(problem, options, context);
}

OscillatorOracle duffingOracle(double zeta, double gamma, double force) {
  const auto vector = [](double value) { return Eigen::VectorXd::Constant(1, value).eval(); };
  return {2 * zeta, [=](const Eigen::VectorXd& x) { return vector(x[0] + gamma * std::pow(x[0], 3)); },
          [=](const Eigen::VectorXd& x) { return Eigen::MatrixXd(vector(1 + 3 * gamma * x[0] * x[0])); },
          [=](double tau) { return vector(force * std::cos(tau)); }};
}

/// A mass that hangs on a spring from a pivot that is shaken vertically (2D): sideways a parametrically driven
/// pendulum.
struct ShakenPendulum {
  double stiffness = 400;
  double length = 1;
  double damping = 0.1;
  double amplitude = 0.08;
  static constexpr double gravity = 9.81;

  std::shared_ptr<const Model> model() const {
    auto made = std::make_shared<Model>();
    made->dimension = 2;
    made->restPositions = Eigen::Vector4d(0, 0, 0, -length - gravity / stiffness);
    made->gravity = vector2(0, -gravity);
    made->lockedCoordinates = {0, 0, 0, 0};
    made->energies = {mechanics::makeSpring(2, 0, 1, length, {{stiffness}})};
    addPointMass(*made, "bob", {1}, 1);
    made->massDamping = damping;
    made->drives = {mechanics::makeTranslation({0}, vector2(0, 1), sine(amplitude))};
    made->probes = {{"bob", 1}};
    made->finish();
    return made;
  }

  /// The trace of the monodromy matrix of the sideways motion, whose equation along the vertical oscillation
  /// (known in closed form) is x'' + c x' + k (1 - L / r(t)) x = 0.
  double trace(double omega) const {
    const std::complex<double> swing =
        amplitude * stiffness / std::complex<double>(stiffness - omega * omega, damping * omega);
    const auto rate = [&](double t, const Eigen::Matrix2d& y) {
      const std::complex<double> turn = std::polar(1.0, omega * t);
      const double r = amplitude * turn.imag() + length + gravity / stiffness - (swing * turn).imag();
      Eigen::Matrix2d d;
      d.row(0) = y.row(1);
      d.row(1) = -damping * y.row(1) - stiffness * (1 - length / r) * y.row(0);
      return d;
    };
    Eigen::Matrix2d y = Eigen::Matrix2d::Identity();
    constexpr int steps = 4000;
    const double h = 2 * std::numbers::pi / omega / steps;
    for (int i = 0; i < steps; ++i) {
      const double t = i * h;
      const Eigen::Matrix2d k1 = rate(t, y);
      const Eigen::Matrix2d k2 = rate(t + h / 2, y + h / 2 * k1);
      const Eigen::Matrix2d k3 = rate(t + h / 2, y + h / 2 * k2);
      const Eigen::Matrix2d k4 = rate(t + h, y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return y.trace();
  }

  /// det = exp(-c T), so a multiplier is -1 where trace = -1 - exp(-c T).
  double boundary(double low, double high) const {
    const auto defect = [&](double omega) {
      return trace(omega) + 1 + std::exp(-damping * 2 * std::numbers::pi / omega);
    };
    const bool rising = defect(low) < 0;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      ((defect(middle) < 0) == rising ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
};

/// A row of masses on linear springs between two walls, driven at the first; node 1 may be massless.
std::shared_ptr<const Model> linearRow(double massDamping, double stiffnessDamping, double secondMass) {
  auto model = std::make_shared<Model>();
  model->dimension = 1;
  model->restPositions = Eigen::Vector3d(0, 1, 2);
  model->gravity = Eigen::VectorXd::Zero(1);
  model->lockedCoordinates = {0, 0, 0};
  const Eigen::VectorXd right = Eigen::VectorXd::Ones(1);
  model->energies = {mechanics::makeGroundedSpring(1, 0, Eigen::VectorXd::Zero(1), right, {{2}}),
                     mechanics::makeSpring(1, 0, 1, 1, {{3}}), mechanics::makeSpring(1, 1, 2, 1, {{5}})};
  addPointMass(*model, "first", {0}, 1);
  if (secondMass > 0) addPointMass(*model, "second", {1}, secondMass);
  addPointMass(*model, "third", {2}, 2);
  model->massDamping = massDamping;
  model->stiffnessDamping = stiffnessDamping;
  model->forces = {{"push", {0}, right, cosine(0.3)}};
  model->finish();
  return model;
}

/// exp(2π λ / ω) of the roots of det(λ² M + λ (α M + β K) + K).
std::vector<std::complex<double>> linearMultipliers(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                                                    double alpha, double beta, double omega) {
  const Eigen::Index n = mass.rows();
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n).setIdentity();
  companion.bottomLeftCorner(n, n) = -mass.inverse() * stiffness;
  companion.bottomRightCorner(n, n) = -mass.inverse() * (alpha * mass + beta * stiffness);
  std::vector<std::complex<double>> multipliers;
  for (const std::complex<double> exponent : companion.eigenvalues())
    multipliers.push_back(std::exp(2 * std::numbers::pi / omega * exponent));
  return multipliers;
}

Stability stabilityOf(const std::shared_ptr<const Model>& model, double omega) {
  HarmonicBalanceProblem problem(model, {harmonics, 64});
  base::ExecutionContext context;
  const auto motion = harmonic::solvePeriodicMotion(problem, omega, {}, context);
  return harmonic::floquetStability(problem, motion.z, omega);
}

}  // namespace

/// Hill's method against closed forms and time integration.
class TestFloquetStability : public QObject {
  Q_OBJECT

 private slots:
  void multipliersOfALinearRowAreTheClosedForm();
  void masslessCoordinatesAreEliminated();
  void multipliersOfTheDuffingOscillatorAgreeWithItsMonodromyMatrix();
  void disturbancesGrowOrDieAsFound();
  void periodDoublingsOfAShakenPendulumAgreeWithItsHillEquation();
  void stabilityCanBeLeftOut();
};

void TestFloquetStability::multipliersOfALinearRowAreTheClosedForm() {
  const double alpha = 0.05, beta = 0.02, omega = 1.1;
  const Stability stability = stabilityOf(linearRow(alpha, beta, 0.7), omega);
  QVERIFY(stability.state == StabilityState::stable);
  Eigen::Matrix3d stiffness;
  stiffness << 5, -3, 0, -3, 8, -5, 0, -5, 5;
  const Eigen::Matrix3d mass = Eigen::Vector3d(1, 0.7, 2).asDiagonal();
  const auto expected = linearMultipliers(mass, stiffness, alpha, beta, omega);
  QCOMPARE(stability.multipliers.size(), expected.size());
  QVERIFY(distanceBetween(stability.multipliers, expected) < 1e-8);
  QVERIFY(distanceBetween(expected, stability.multipliers) < 1e-8);
}

void TestFloquetStability::masslessCoordinatesAreEliminated() {
  const double alpha = 0.05, omega = 1.1;
  const Stability stability = stabilityOf(linearRow(alpha, 0, 0), omega);
  const double inSeries = 1 / (1 / 3.0 + 1 / 5.0);
  Eigen::Matrix2d stiffness;
  stiffness << 2 + inSeries, -inSeries, -inSeries, inSeries;
  const Eigen::Matrix2d mass = Eigen::Vector2d(1, 2).asDiagonal();
  const auto expected = linearMultipliers(mass, stiffness, alpha, 0, omega);
  QCOMPARE(stability.multipliers.size(), expected.size());
  QVERIFY(distanceBetween(stability.multipliers, expected) < 1e-8);
}

void TestFloquetStability::multipliersOfTheDuffingOscillatorAgreeWithItsMonodromyMatrix() {
  const double zeta = 0.02, gamma = 0.5, force = 0.1;
  const OscillatorOracle oracle = duffingOracle(zeta, gamma, force);
  const FrequencyResponse response = trace(duffing(zeta, gamma, force), 0.5, 2);
  int stable = 0, unstable = 0, folds = 0;
  for (const ResponsePoint& point : response.points) {
    QVERIFY(point.stability.state != StabilityState::unknown);
    QVERIFY(point.kind == PointKind::regular || point.kind == PointKind::peak || point.kind == PointKind::fold);
    if (point.kind == PointKind::fold) {
      QCOMPARE(point.stability.unstableCount, 0);
      ++folds;
      continue;
    }
    const auto expected = oracle.multipliers(startOfSeries(point.z, harmonics, point.omega), point.omega);
    QCOMPARE(point.stability.multipliers.size(), expected.size());
    const double distance = distanceBetween(point.stability.multipliers, expected);
    QVERIFY2(distance < 2e-5, qPrintable(QString("%1 at %2").arg(distance).arg(point.omega)));
    QCOMPARE(point.stability.state == StabilityState::stable, std::abs(expected[0]) < 1);
    ++(point.stability.state == StabilityState::stable ? stable : unstable);
  }
  QCOMPARE(folds, 2);
  QVERIFY(stable > 20 && unstable > 5);
}

void TestFloquetStability::disturbancesGrowOrDieAsFound() {
  const double zeta = 0.02, gamma = 0.5, force = 0.1;
  const OscillatorOracle oracle = duffingOracle(zeta, gamma, force);
  for (const ResponsePoint& point : trace(duffing(zeta, gamma, force), 0.5, 2).points) {
    // The neighbourhood of the folds on either side of them: from 1.1 to 1.46.
    if (point.kind == PointKind::fold || point.omega < 1.1 || point.omega > 1.46) continue;
    const Eigen::VectorXd start = startOfSeries(point.z, harmonics, point.omega);
    Eigen::VectorXd disturbed = start + Eigen::Vector2d(1e-4, 5e-5);
    for (int period = 0; period < 60; ++period) disturbed = oracle.period(disturbed, point.omega);
    const bool returned = (disturbed - start).norm() < 0.5e-4;
    const double largest = std::abs(point.stability.multipliers[0]);
    if (largest > 0.97 && largest < 1.05) continue;  // too slow to tell within sixty periods
    QCOMPARE(returned, point.stability.state == StabilityState::stable);
  }
}

void TestFloquetStability::periodDoublingsOfAShakenPendulumAgreeWithItsHillEquation() {
  const ShakenPendulum pendulum;
  const FrequencyResponse response = trace(pendulum.model(), 5.2, 7.2);
  QVERIFY2(response.report.converged(), response.report.message.c_str());
  std::vector<ResponsePoint> found;
  for (const ResponsePoint& point : response.points)
    if (point.kind != PointKind::regular && point.kind != PointKind::peak) found.push_back(point);
  QCOMPARE(found.size(), 2u);
  const double middle = 2 * std::sqrt(pendulum.gravity / (pendulum.length + pendulum.gravity / pendulum.stiffness));
  const double expected[] = {pendulum.boundary(5.2, middle), pendulum.boundary(middle, 7.2)};
  for (int i = 0; i < 2; ++i) {
    QVERIFY(found[i].kind == PointKind::periodDoubling);
    QVERIFY2(std::abs(found[i].omega / expected[i] - 1) < 2e-6,
             qPrintable(QString("%1 %2").arg(found[i].omega, 0, 'g', 12).arg(expected[i], 0, 'g', 12)));
    QVERIFY(std::abs(harmonic::criticalMultiplier(found[i]) + 1.0) < 1e-3);
    QCOMPARE(found[i].stability.unstableCount, 0);
  }
  for (const ResponsePoint& point : response.points) {
    if (point.kind == PointKind::periodDoubling) continue;
    QCOMPARE(point.stability.unstableCount, point.omega > expected[0] && point.omega < expected[1] ? 1 : 0);
  }
}

void TestFloquetStability::stabilityCanBeLeftOut() {
  HarmonicBalanceProblem problem(duffing(0.02, 0.5, 0.1), {harmonics, 64});
  base::ExecutionContext context;
  harmonic::FrequencyResponseOptions options;
  options.from = 0.5;
  options.to = 0.9;
  options.stability = false;
  for (const ResponsePoint& point : harmonic::traceFrequencyResponse(problem, options, context).points) {
    QVERIFY(point.stability.state == StabilityState::unknown);
    QVERIFY(point.stability.multipliers.empty());
  }
}

QTEST_GUILESS_MAIN(TestFloquetStability)
#include "test_floquet_stability.moc"
