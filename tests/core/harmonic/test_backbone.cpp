#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/harmonic/backbone.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::Backbone;
using harmonic::HarmonicBalanceProblem;
using harmonic::ResponsePoint;

namespace {

Backbone trace(const std::shared_ptr<const Model>& model, int mode, double amplitude, int harmonics) {
  const HarmonicBalanceProblem free = harmonic::freeProblem(HarmonicBalanceProblem(model, {harmonics, 6 * harmonics}));
  base::ExecutionContext context;
  harmonic::BackboneOptions options;
  options.mode = mode;
  options.maximumAmplitude = amplitude;
  return harmonic::traceBackbone(free, options, context);
}

/// Frequency of x'' + x + γ x³ = 0 at amplitude A: 2π / (4 K(m)) √(1 + γ A²) with m = γ A² / (2 (1 + γ A²)), and
/// K(m) = π / (2 agm(1, √(1 - m))).
double duffingFrequency(double gamma, double amplitude) {
  const double stiffening = gamma * amplitude * amplitude;
  double a = 1, b = std::sqrt(1 - stiffening / (2 * (1 + stiffening)));
  for (int i = 0; i < 30; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return a * std::sqrt(1 + stiffening);
}

/// Two unit masses between walls, springs 1, c, 1, of which the outer ones harden. They are so far apart that they
/// never meet.
std::shared_ptr<const Model> twoMasses(double coupling, double hardening) {
  constexpr double distance = 10;
  auto model = std::make_shared<Model>();
  model->dimension = 1;
  model->restPositions = Eigen::Vector2d(0, distance);
  model->gravity = Eigen::VectorXd::Zero(1);
  model->lockedCoordinates = {0, 0};
  const Eigen::VectorXd right = Eigen::VectorXd::Ones(1);
  model->energies = {mechanics::makeGroundedSpring(1, 0, Eigen::VectorXd::Zero(1), right, {{1, 0, hardening}}),
                     mechanics::makeGroundedSpring(1, 1, distance * right, right, {{1, 0, hardening}}),
                     mechanics::makeSpring(1, 0, 1, distance, {{coupling}})};
  addPointMass(*model, "masses", {0, 1}, 1);
  model->massDamping = 0.1;
  model->forces = {{"push", {0}, right, cosine(0.3)}};
  model->finish();
  return model;
}

}  // namespace

/// Free motions against the elliptic functions that solve the undamped Duffing equation.
class TestBackbone : public QObject {
  Q_OBJECT

 private slots:
  void theDuffingOscillatorFollowsTheEllipticFunctions_data();
  void theDuffingOscillatorFollowsTheEllipticFunctions();
  void symmetricModesAreSingleOscillators_data();
  void symmetricModesAreSingleOscillators();
  void modesThatAreNotThereAreRefused();
};

void TestBackbone::theDuffingOscillatorFollowsTheEllipticFunctions_data() {
  QTest::addColumn<double>("gamma");
  QTest::addColumn<double>("amplitude");
  QTest::newRow("hardening") << 0.5 << 3.0;
  QTest::newRow("softening") << -0.2 << 1.5;
}

void TestBackbone::theDuffingOscillatorFollowsTheEllipticFunctions() {
  QFETCH(double, gamma);
  QFETCH(double, amplitude);
  const Backbone backbone = trace(duffing(0.02, gamma, 0.1), 1, amplitude, 17);
  QVERIFY2(backbone.report.converged(), backbone.report.message.c_str());
  QVERIFY(std::abs(backbone.linearFrequency - 1) < 1e-12);
  QVERIFY(backbone.points.size() > 10);
  double reached = 0;
  for (const ResponsePoint& point : backbone.points) {
    double start = point.z[0];
    for (int k = 1; k <= 17; ++k) start += point.z[2 * k];
    const double expected = duffingFrequency(gamma, start);
    QVERIFY2(std::abs(point.omega - expected) < 1e-7 * expected,
             qPrintable(QString("%1 %2 %3").arg(start).arg(point.omega, 0, 'g', 12).arg(expected, 0, 'g', 12)));
    QVERIFY(std::abs(point.amplitudes[0].pathLength - 4 * std::abs(start)) < 1e-6 * std::abs(start));
    reached = std::max(reached, std::abs(start));
  }
  QVERIFY(reached >= amplitude && reached < 1.2 * amplitude);
}

void TestBackbone::symmetricModesAreSingleOscillators_data() {
  QTest::addColumn<int>("mode");
  QTest::newRow("in phase") << 1;
  QTest::newRow("against one another") << 2;
}

void TestBackbone::symmetricModesAreSingleOscillators() {
  // In the second mode, each mass moves as if the spring between them, halved, were held in its middle.
  QFETCH(int, mode);
  const double coupling = 0.7, hardening = 0.4;
  const Backbone backbone = trace(twoMasses(coupling, hardening), mode, 1.5, 15);
  QVERIFY2(backbone.report.converged(), backbone.report.message.c_str());
  const double linear = mode == 1 ? 1.0 : std::sqrt(1 + 2 * coupling);
  for (const ResponsePoint& point : backbone.points) {
    const Eigen::Index width = 2 * 15 + 1;
    double first = 0, second = -10;
    for (int k = 0; k <= 15; ++k) {
      first += point.z[2 * k];
      second += point.z[width + 2 * k];
    }
    QVERIFY(std::abs(first - (mode == 1 ? second : -second)) < 1e-8);
    const double expected = linear * duffingFrequency(hardening / (linear * linear), first);
    QVERIFY(std::abs(point.omega - expected) < 1e-7 * expected);
  }
}

void TestBackbone::modesThatAreNotThereAreRefused() {
  QVERIFY_EXCEPTION_THROWN(trace(duffing(0.02, 0.5, 0.1), 2, 1, 5), base::InputError);
}

QTEST_GUILESS_MAIN(TestBackbone)
#include "test_backbone.moc"
