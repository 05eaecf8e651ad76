#include <QTest>
#include <complex>

#include "core/base/error.hpp"
#include "core/harmonic/floquet_stability.hpp"
#include "core/harmonic/frequency_response.hpp"
#include "core/harmonic/response_sensitivity.hpp"
#include "core/harmonic/torus_path.hpp"
#include "core/mechanics/family_parameter.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;
using math::HarmonicBasis;
using std::numbers::pi;

namespace {

constexpr double zeta = 0.1, hardening = 0.8, low = 0.35, high = 0.5, phase = 0.7;
constexpr double omega = 0.9, ratio = std::numbers::sqrt2;

/// x'' + 2 ζ x' + x + γ x³ = P cos ωt + Q cos(rωt + φ).
std::shared_ptr<Model> tones(double p, double q, double cubic = hardening) {
  auto model = std::make_shared<Model>(*duffing(zeta, cubic, 0));
  model->forces = {{"low", {0}, vector2(1, 0), {{{1, p, 0}}}}, {"high", {0}, vector2(1, 0), {{{1, q, phase, true}}}}};
  model->familyValues = {p, q};
  model->finish();
  return model;
}

/// With the mass and both amplitudes as parameters.
std::shared_ptr<const Model> example() {
  auto model = tones(low, high);
  const auto family = std::make_shared<const mechanics::ModelFamily>(
      [](const std::vector<double>& values) { return *tones(values[0], values[1]); });
  model->parameters.push_back(mechanics::makeFamilyParameter(0, {"low", "/low", base::dimensions::none, 0, 1}, family));
  model->parameters.push_back(
      mechanics::makeFamilyParameter(1, {"high", "/high", base::dimensions::none, 0, 1}, family));
  return model;
}

HarmonicBalanceProblem problemOf(std::shared_ptr<const Model> model, int order, double r = ratio) {
  return {std::move(model), HarmonicBasis::ofTwoFrequencies(order, 4 * order + 1, r)};
}

PeriodicMotion solve(HarmonicBalanceProblem problem, double frequency = omega, const Vector& start = {}) {
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions options;
  options.tolerance = options.stepTolerance = 1e-13;
  PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, frequency, options, context, start);
  if (!motion.report.converged()) QTest::qFail(motion.report.message.c_str(), __FILE__, __LINE__);
  return motion;
}

/// The example by Runge-Kutta's method of order 4, from rest: knows nothing of harmonic balance.
class Oscillator {
 public:
  double time() const { return step_ * static_cast<double>(count_); }
  double position() const { return x_; }
  double speed() const { return std::abs(v_); }

  void advance() {
    const double t = time(), h = step_;
    const double v1 = v_, a1 = rate(t, x_, v_);
    const double v2 = v_ + h / 2 * a1, a2 = rate(t + h / 2, x_ + h / 2 * v1, v2);
    const double v3 = v_ + h / 2 * a2, a3 = rate(t + h / 2, x_ + h / 2 * v2, v3);
    const double v4 = v_ + h * a3, a4 = rate(t + h, x_ + h * v3, v4);
    x_ += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    v_ += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    ++count_;
  }
  /// Until transients have died away to e^{-35} of themselves.
  void settle() {
    while (time() < 350) advance();
  }

 private:
  static double rate(double t, double x, double v) {
    return low * std::cos(omega * t) + high * std::cos(ratio * omega * t + phase) - 2 * zeta * v - x -
           hardening * x * x * x;
  }

  double step_ = 0.01, x_ = 0, v_ = 0;
  long count_ = 0;
};

double positionAt(const HarmonicBalanceProblem& problem, const Vector& z, double time, double frequency = omega) {
  return problem.configurationAt(z, frequency * time / problem.drivePeriods())[0];
}

}  // namespace

/// Drives at two frequencies without a common period.
class TestTwoFrequencies : public QObject {
  Q_OBJECT

 private slots:
  void secondFrequencyWithoutForceChangesNothing();
  void linearAnswersAddUp();
  void agreesWithRungeKutta();
  void wholeRatioIsThatOfOrders();
  void sensitivitiesAgreeWithDifferences();
  void meansAndExtremesAreThoseOfLongTimes();
  void pathLengthGradient();
  void responseCurve();
  void whatDoesNotApplyIsRefused();
};

void TestTwoFrequencies::secondFrequencyWithoutForceChangesNothing() {
  constexpr int order = 7;
  const Vector single = solve({duffing(zeta, hardening, low), HarmonicBasis(order, 4 * order + 1)}).z;
  const HarmonicBalanceProblem problem = problemOf(tones(low, 0), order);
  const Vector both = solve(problem).z;
  double largest = 0;
  for (int k = 1; k <= problem.basis().harmonics(); ++k) {
    const auto [first, second] = problem.basis().combination(k);
    const Eigen::Vector2d expected =
        second == 0 ? Eigen::Vector2d(single.segment<2>(2 * first - 1)) : Eigen::Vector2d::Zero();
    largest = std::max(largest, (both.segment<2>(2 * k - 1) - expected).norm());
  }
  QVERIFY2(largest < 1e-12, qPrintable(QString::number(largest)));
}

/// A mass on a driven base and with a force: x'' + 2 ζ x' + x = p + base, each with a frequency of its own.
void TestTwoFrequencies::linearAnswersAddUp() {
  constexpr double length = 8;  // more than it swings, so that the spring keeps its direction
  auto model = std::make_shared<Model>();
  model->dimension = 1;
  model->restPositions = vector2(0, length);
  model->energies = {mechanics::makeSpring(1, 0, 1, length, {{1}})};
  addPointMass(*model, "mass", {1}, 1);
  model->massDamping = 2 * zeta;
  model->drives = {mechanics::makeTranslation({0}, Vector::Ones(1), {{{2, 0.2, 0.3, true}}})};
  model->forces = {{"force", {1}, Vector::Ones(1), {{{1, low, 0}, {3, 0.1, phase, true}}}}};
  model->finish();
  const HarmonicBalanceProblem problem = problemOf(model, 3);
  const Vector z = solve(problem).z;
  const auto answer = [](double frequency, double force, double angle) {
    const std::complex<double> i(0, 1);
    return force * std::exp(i * angle) / (1 - frequency * frequency + 2 * zeta * frequency * i);
  };
  double worst = 0;
  for (double time = 0; time < 400; time += 1.7) {
    double expected = length;
    const auto add = [&](double frequency, double force, double angle) {
      expected += std::real(answer(frequency, force, angle) * std::polar(1.0, frequency * time));
    };
    add(omega, low, 0);
    add(3 * ratio * omega, 0.1, phase);
    add(2 * ratio * omega, 0.2, 0.3);
    const double tau = omega * time / problem.drivePeriods();
    worst = std::max(worst, std::abs(problem.configurationAt(z, tau)[1] - expected));
  }
  QVERIFY2(worst < 1e-12, qPrintable(QString::number(worst)));
}

void TestTwoFrequencies::agreesWithRungeKutta() {
  std::vector<double> times, positions;
  Oscillator oscillator;
  for (oscillator.settle(); oscillator.time() < 650; oscillator.advance()) {
    times.push_back(oscillator.time());
    positions.push_back(oscillator.position());
  }
  double before = 1;
  for (const int order : {3, 5, 7, 9, 11}) {
    const HarmonicBalanceProblem problem = problemOf(example(), order);
    const Vector z = solve(problem).z;
    double error = 0;
    for (std::size_t i = 0; i < times.size(); i += 7)
      error = std::max(error, std::abs(positionAt(problem, z, times[i]) - positions[i]));
    qInfo("H = %d: largest difference %.3g", order, error);
    QVERIFY(error < 0.4 * before);
    before = error;
  }
  QVERIFY2(before < 3e-4, qPrintable(QString::number(before)));
}

/// 3 : 2 both ways. The series in both phases holds the motions for all shifts between the two drives, so it needs as
/// many orders as the worst of them.
void TestTwoFrequencies::wholeRatioIsThatOfOrders() {
  auto model = std::make_shared<Model>(*duffing(zeta, hardening, 0));
  model->forces = {{"low", {0}, vector2(1, 0), {{{2, low, 0}}}}, {"high", {0}, vector2(1, 0), {{{3, high, phase}}}}};
  model->finish();
  const HarmonicBalanceProblem single(model, HarmonicBasis(41, 256));
  const Vector expected = solve(single, omega / 2).z;
  double before = 1;
  for (const int order : {5, 9, 13}) {
    const HarmonicBalanceProblem both = problemOf(tones(low, high), order, 1.5);
    const Vector z = solve(both).z;
    QCOMPARE(both.drivePeriods(), 2);
    double error = 0;
    for (double tau = 0; tau < 2 * pi; tau += 0.01)
      error = std::max(error, std::abs(both.configurationAt(z, tau)[0] - single.configurationAt(expected, tau)[0]));
    qInfo("H = %d: largest difference %.3g", order, error);
    QVERIFY(error < 0.2 * before);
    before = error;
  }
  QVERIFY(before < 1e-5);
}

void TestTwoFrequencies::sensitivitiesAgreeWithDifferences() {
  const auto model = example();
  const PeriodicMotion motion = solve(problemOf(model, 5));
  const harmonic::ResponseSensitivity sensitivity(problemOf(model, 5), motion);
  for (std::size_t p = 0; p < 3; ++p) {
    const auto& parameter = *model->parameters[p];
    const double step = 1e-3;
    const auto at = [&](double change) {
      const double value = parameter.value(*model) + change;
      return solve(problemOf(std::make_shared<const Model>(parameter.withValue(*model, value)), 5), omega, motion.z).z;
    };
    const Vector difference = (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
    const double error =
        (sensitivity.derivative().col(static_cast<Eigen::Index>(p)) - difference).norm() / difference.norm();
    QVERIFY2(error < 1e-6, qPrintable(QString::number(error)));
  }
}

void TestTwoFrequencies::meansAndExtremesAreThoseOfLongTimes() {
  // Weighted with a bump, means over a quasi-periodic motion converge fast (Das, Saiki, Sander and Yorke 2016).
  constexpr double span = 3000;
  Oscillator oscillator;
  oscillator.settle();
  const double begin = oscillator.time();
  double weights = 0, speeds = 0, highest = 0, lowest = 0;
  for (oscillator.advance(); oscillator.time() < begin + span; oscillator.advance()) {
    const double s = (oscillator.time() - begin) / span;
    const double weight = std::exp(-1 / (s * (1 - s)));
    weights += weight;
    speeds += weight * oscillator.speed();
    highest = std::max(highest, oscillator.position());
    lowest = std::min(lowest, oscillator.position());
  }
  const HarmonicBalanceProblem problem = problemOf(example(), 13);
  const Vector z = solve(problem).z;
  const auto amplitude = harmonic::amplitude(problem, z, 0);
  const double expected = 2 * pi / omega * speeds / weights;
  QVERIFY2(std::abs(amplitude.pathLength - expected) < 2e-4 * expected,
           qPrintable(QString::number(amplitude.pathLength / expected - 1)));
  const double farthest = std::max(highest, -lowest);  // odd motions have their mean at 0
  QVERIFY2(std::abs(amplitude.maximumDisplacement - farthest) < 1e-3 * farthest,
           qPrintable(QString::number(amplitude.maximumDisplacement / farthest - 1)));
}

void TestTwoFrequencies::pathLengthGradient() {
  const HarmonicBasis basis = HarmonicBasis::ofTwoFrequencies(3, 7, ratio);
  const Matrix path = randomVector(2 * basis.size(), 5).reshaped(basis.size(), 2);
  const Matrix direction = randomVector(2 * basis.size(), 6).reshaped(basis.size(), 2);
  Matrix gradient;
  harmonic::meanPathLength(basis, path, &gradient);
  const double step = 1e-4;
  const double difference = (harmonic::meanPathLength(basis, path + step * direction) -
                             harmonic::meanPathLength(basis, path - step * direction)) /
                            (2 * step);
  const double derivative = gradient.cwiseProduct(direction).sum();
  QVERIFY2(std::abs(derivative - difference) < 1e-5 * std::abs(difference),
           qPrintable(QString::number(derivative / difference - 1)));
  // A circle that is gone through once in a period of the first frequency, and a sine.
  Matrix circle = Matrix::Zero(basis.size(), 2);
  circle(1, 0) = circle(2, 1) = 0.3;
  QVERIFY(std::abs(harmonic::meanPathLength(basis, circle) - 2 * pi * 0.3) < 1e-12);
  QVERIFY(std::abs(harmonic::meanPathLength(basis, circle.leftCols(1)) - 4 * 0.3) < 2e-5);
  QVERIFY(std::abs(harmonic::largestDisplacement(basis, circle.leftCols(1)) - 0.3) < 1e-9);
}

/// With the ratio kept; the curve goes through the motions found at one frequency.
void TestTwoFrequencies::responseCurve() {
  HarmonicBalanceProblem problem = problemOf(tones(0.1, 0.1, 0.1), 3);
  harmonic::FrequencyResponseOptions options;
  options.from = 0.5;
  options.to = 1.4;
  options.stability = false;
  base::ExecutionContext context;
  const auto response = harmonic::traceFrequencyResponse(problem, options, context);
  QVERIFY(response.report.converged());
  int peaks = 0;
  double worst = 0;
  for (const harmonic::ResponsePoint& point : response.points) {
    peaks += point.kind == harmonic::PointKind::peak;
    worst = std::max(worst, (solve(problem, point.omega, point.z).z - point.z).norm() / point.z.norm());
  }
  QVERIFY2(worst < 1e-7, qPrintable(QString::number(worst)));
  QVERIFY(peaks >= 2);  // where either frequency meets the natural one
}

void TestTwoFrequencies::whatDoesNotApplyIsRefused() {
  try {
    static_cast<void>(HarmonicBalanceProblem(tones(low, high), HarmonicBasis(5, 21)));
    QFAIL("the second frequency was not missed");
  } catch (const base::InputError& error) {
    QVERIFY(std::string(error.what()).find("second frequency") != std::string::npos);
  }
  const HarmonicBalanceProblem problem = problemOf(tones(low, high), 3);
  const Vector z = solve(problem).z;
  QVERIFY(harmonic::floquetStability(problem, z, omega).state == harmonic::StabilityState::unknown);
  QVERIFY_THROWS_EXCEPTION(std::invalid_argument, static_cast<void>(problem.withDrivePeriods(2)));
}

QTEST_GUILESS_MAIN(TestTwoFrequencies)
#include "test_two_frequencies.moc"
