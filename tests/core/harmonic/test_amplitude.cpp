#include <QTest>
#include <cmath>
#include <numbers>

#include "core/harmonic/amplitude.hpp"

using namespace pliant;
using harmonic::HarmonicBalanceProblem;
using harmonic::Vector;

namespace {

constexpr int harmonics = 5;

/// One free node in three dimensions.
HarmonicBalanceProblem freeNode() {
  auto model = std::make_shared<mechanics::Model>();
  model->restPositions = Eigen::Vector3d(1, 2, 3);
  model->pointMasses.push_back({"bob", {0}, 1, 0, 2});
  model->gravity = Eigen::Vector3d::Zero();
  model->lockedCoordinates.assign(3, 0);
  model->finish();
  return {model, {harmonics, 64}};
}

/// Sets amplitude cos(order τ + phase) in one coordinate.
void addTerm(Vector& z, int axis, int order, double amplitude, double phase) {
  const int first = axis * (2 * harmonics + 1);
  z[first + 2 * order - 1] -= amplitude * std::sin(phase);
  z[first + 2 * order] += amplitude * std::cos(phase);
}

bool near(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); }

}  // namespace

class TestAmplitude : public QObject {
  Q_OBJECT
 private slots:
  void straightSwing();
  void circle();
  void ellipse();
  void twoTurnsBackOnALine();
  void gradientOfStraightSwing();
};

void TestAmplitude::straightSwing() {
  const auto problem = freeNode();
  for (const double phase : {0.0, 0.013, 0.7, 2.1}) {  // whatever the place of the samples
    Vector z = problem.restCoefficients();
    addTerm(z, 0, 1, 0.3, phase);
    addTerm(z, 2, 1, 0.4, phase);
    const auto amplitude = harmonic::amplitude(problem, z, 0);
    QVERIFY(near(amplitude.pathLength, 4 * 0.5));
    QVERIFY(near(amplitude.maximumDisplacement, 0.5));
  }
}

void TestAmplitude::circle() {
  const auto problem = freeNode();
  Vector z = problem.restCoefficients();
  addTerm(z, 0, 1, 0.2, 0);
  addTerm(z, 1, 1, 0.2, -std::numbers::pi / 2);
  const auto amplitude = harmonic::amplitude(problem, z, 0);
  QVERIFY(near(amplitude.pathLength, 2 * std::numbers::pi * 0.2));
  QVERIFY(near(amplitude.maximumDisplacement, 0.2));
}

void TestAmplitude::ellipse() {
  const auto problem = freeNode();
  for (const double minor : {0.5, 0.1, 1e-3, 1e-6}) {
    Vector z = problem.restCoefficients();
    addTerm(z, 0, 1, 1.0, 0.4);
    addTerm(z, 1, 1, minor, 0.4 - std::numbers::pi / 2);
    const auto amplitude = harmonic::amplitude(problem, z, 0);
    QVERIFY(near(amplitude.pathLength, 4 * std::comp_ellint_2(std::sqrt(1 - minor * minor))));
    QVERIFY(near(amplitude.maximumDisplacement, 1.0));
  }
}

void TestAmplitude::twoTurnsBackOnALine() {
  // x = cos τ + b cos 2τ turns at τ = 0 and π and, for b > 1/4, where cos τ = -1 / (4 b).
  const double b = 0.8;
  const auto problem = freeNode();
  Vector z = problem.restCoefficients();
  addTerm(z, 1, 1, 1, 0);
  addTerm(z, 1, 2, b, 0);
  const double lowest = -1 / (8 * b) - b;
  const auto amplitude = harmonic::amplitude(problem, z, 0);
  QVERIFY(near(amplitude.pathLength, 2 * ((1 + b - lowest) + (-1 + b - lowest))));
  QVERIFY(near(amplitude.maximumDisplacement, 1 + b));
}

void TestAmplitude::gradientOfStraightSwing() {
  // The length 4 sqrt(s² + c²) of a swing by s sin τ + c cos τ.
  const auto problem = freeNode();
  Vector z = problem.restCoefficients();
  addTerm(z, 0, 1, 0.5, 0.6);
  const Vector gradient = harmonic::pathLengthGradient(problem, z, 0);
  QVERIFY(std::abs(gradient[0]) < 1e-9);
  QVERIFY(near(gradient[1], -4 * std::sin(0.6)));
  QVERIFY(near(gradient[2], 4 * std::cos(0.6)));
}

QTEST_GUILESS_MAIN(TestAmplitude)
#include "test_amplitude.moc"
