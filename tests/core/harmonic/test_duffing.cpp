#include <QTest>

#include "core/harmonic/frequency_response.hpp"
#include "core/harmonic/periodic_motion.hpp"
#include "tests/core/harmonic/duffing_oracle.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::FrequencyResponse;
using harmonic::PointKind;
using harmonic::ResponsePoint;

namespace {

constexpr double zeta = 0.02;
constexpr double gamma = 0.5;
constexpr double force = 0.1;
constexpr int harmonics = 9;
const DuffingOracle oracle{zeta, gamma, force};

FrequencyResponse trace(double from, double to) {
  harmonic::HarmonicBalanceProblem problem(duffing(zeta, gamma, force), {harmonics, 64});
  base::ExecutionContext context;
  harmonic::FrequencyResponseOptions options;
  options.from = from;
  options.to = to;
  return harmonic::traceFrequencyResponse(problem, options, context);
}

const FrequencyResponse& upwards() {
  static const FrequencyResponse response = trace(0.3, 2.5);
  return response;
}

std::vector<ResponsePoint> pointsOfKind(const FrequencyResponse& response, PointKind kind) {
  std::vector<ResponsePoint> result;
  for (const ResponsePoint& point : response.points)
    if (point.kind == kind) result.push_back(point);
  return result;
}

/// x and dx/dt at τ = 0.
Eigen::Vector2d startOf(const ResponsePoint& point) {
  Eigen::Vector2d start(point.z[0], 0);
  for (int k = 1; k <= harmonics; ++k) {
    start[0] += point.z[2 * k];
    start[1] += point.omega * k * point.z[2 * k - 1];
  }
  return start;
}

double largestDifference(const ResponsePoint& point, const DuffingOracle::Orbit& orbit) {
  const math::HarmonicBasis basis(harmonics, 64);
  double largest = 0;
  for (std::size_t i = 0; i < orbit.positions.size(); i += 40) {
    const double tau = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(orbit.positions.size());
    largest = std::max(largest, std::abs(basis.valuesAt(tau).dot(point.z) - orbit.positions[i]));
  }
  return largest;
}

/// One motion; at no frequency if there is none.
ResponsePoint solveAt(double omega, const harmonic::PeriodicMotionOptions& options) {
  harmonic::HarmonicBalanceProblem problem(duffing(zeta, gamma, force), {harmonics, 64});
  base::ExecutionContext context;
  const auto motion = harmonic::solvePeriodicMotion(problem, omega, options, context);
  ResponsePoint point;
  if (!motion.report.converged()) return point;
  point.omega = omega;
  point.z = motion.z;
  point.amplitudes = {harmonic::amplitude(problem, motion.z, 0)};
  return point;
}

}  // namespace

class TestDuffing : public QObject {
  Q_OBJECT

 private slots:
  void wholeRangeIsTraced();
  void pointsAgreeWithTimeIntegration();
  void foldsAgreeWithShooting();
  void directionsAgree();
  void peakIsTheLargestAmplitude();
  void curveIsSmooth();
  void startsOnAnyBranchEnd();
  void otherStartsLeadToOtherMotions();
  void theResponseIsFollowedWhereTheRampFails();
};

void TestDuffing::wholeRangeIsTraced() {
  const FrequencyResponse& response = upwards();
  QVERIFY(response.report.converged());
  QCOMPARE(response.points.front().omega, 0.3);
  QCOMPARE(response.points.back().omega, 2.5);
  QCOMPARE(response.report.iterations.size(), response.points.size());
  for (std::size_t i = 1; i < response.points.size(); ++i)
    QVERIFY(response.points[i].arcLength > response.points[i - 1].arcLength);
  for (const ResponsePoint& point : response.points) QVERIFY(point.residual < 1e-9);
}

void TestDuffing::pointsAgreeWithTimeIntegration() {
  const std::vector<ResponsePoint> folds = pointsOfKind(upwards(), PointKind::fold);
  QCOMPARE(folds.size(), 2u);
  int stable = 0, unstable = 0;
  for (const ResponsePoint& point : upwards().points) {
    if (point.kind == PointKind::fold) continue;  // where the oracle's Newton iteration is singular
    const DuffingOracle::Orbit orbit = oracle.orbit(startOf(point), point.omega);
    QVERIFY2(largestDifference(point, orbit) < 1e-6, qPrintable(QString::number(largestDifference(point, orbit))));
    const bool between = point.arcLength > folds[0].arcLength && point.arcLength < folds[1].arcLength;
    QCOMPARE(orbit.stable(), !between);
    ++(between ? unstable : stable);
  }
  QVERIFY(stable > 10);
  QVERIFY(unstable > 5);
}

void TestDuffing::foldsAgreeWithShooting() {
  for (const ResponsePoint& fold : pointsOfKind(upwards(), PointKind::fold)) {
    const double expected = oracle.foldFrequency(startOf(fold), fold.omega);
    QVERIFY2(std::abs(fold.omega - expected) < 1e-6 * expected, qPrintable(QString::number(fold.omega - expected)));
  }
}

void TestDuffing::directionsAgree() {
  const FrequencyResponse down = trace(2.5, 0.3);
  QVERIFY(down.report.converged());
  QCOMPARE(down.points.front().omega, 2.5);
  QCOMPARE(down.points.back().omega, 0.3);
  for (const PointKind kind : {PointKind::fold, PointKind::peak}) {
    const auto forth = pointsOfKind(upwards(), kind);
    auto back = pointsOfKind(down, kind);
    std::reverse(back.begin(), back.end());
    QCOMPARE(back.size(), forth.size());
    for (std::size_t i = 0; i < forth.size(); ++i) {
      QVERIFY(std::abs(forth[i].omega - back[i].omega) < 1e-6 * forth[i].omega);
      QVERIFY((forth[i].z - back[i].z).norm() < 1e-3 * forth[i].z.norm());
    }
  }
}

void TestDuffing::peakIsTheLargestAmplitude() {
  const auto peaks = pointsOfKind(upwards(), PointKind::peak);
  double largestPeak = 0;
  for (const ResponsePoint& peak : peaks) {
    QCOMPARE(peak.probe, 0);
    largestPeak = std::max(largestPeak, peak.amplitudes[0].pathLength);
  }
  for (const ResponsePoint& point : upwards().points)
    QVERIFY(point.amplitudes[0].pathLength <= largestPeak * (1 + 1e-12));
  // The primary resonance: with one harmonic, the amplitude is P / (2 ζ Ω) where force and velocity are in phase.
  const ResponsePoint& primary = *std::max_element(peaks.begin(), peaks.end(), [](const auto& a, const auto& b) {
    return a.amplitudes[0].pathLength < b.amplitudes[0].pathLength;
  });
  QVERIFY(std::abs(primary.amplitudes[0].maximumDisplacement * 2 * zeta * primary.omega / force - 1) < 0.05);
}

void TestDuffing::curveIsSmooth() {
  // In the plane that a person looks at, every point lies close to the chord of its neighbours.
  const auto& points = upwards().points;
  double tallest = 0;
  for (const ResponsePoint& point : points) tallest = std::max(tallest, point.amplitudes[0].pathLength);
  const auto place = [&](std::size_t i) {
    return Eigen::Vector2d(points[i].omega / 2.2, points[i].amplitudes[0].pathLength / tallest);
  };
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d chord = place(i + 1) - place(i - 1);
    const Eigen::Vector2d offset = place(i) - place(i - 1);
    QVERIFY(std::abs(chord[0] * offset[1] - chord[1] * offset[0]) <= 0.03 * chord.norm());
  }
  QVERIFY(points.size() < 250);
}

void TestDuffing::startsOnAnyBranchEnd() {
  // A range that begins between the folds' frequencies: the branch leaves it where it comes back to its beginning, or
  // where it reaches the end, whichever is first; either way the last point lies on a bound.
  const auto folds = pointsOfKind(upwards(), PointKind::fold);
  const double middle = 0.5 * (folds[0].omega + folds[1].omega);
  for (const double to : {0.5, 2.4}) {
    const FrequencyResponse response = trace(middle, to);
    QVERIFY(response.report.converged());
    const double last = response.points.back().omega;
    QVERIFY(last == middle || last == to);
    for (const ResponsePoint& point : response.points)
      QVERIFY(point.omega >= std::min(middle, to) && point.omega <= std::max(middle, to));
  }
}

/// Between the folds, the linear response leads to the small motion, and ten times its opposite to the large one.
void TestDuffing::otherStartsLeadToOtherMotions() {
  harmonic::PeriodicMotionOptions options;
  const ResponsePoint small = solveAt(1.3, options);
  options.startScale = -10;
  const ResponsePoint large = solveAt(1.3, options);
  for (const ResponsePoint& point : {small, large}) {
    QCOMPARE(point.omega, 1.3);
    const DuffingOracle::Orbit orbit = oracle.orbit(startOf(point), point.omega);
    QVERIFY(largestDifference(point, orbit) < 1e-6);
    QVERIFY(orbit.stable());
  }
  QVERIFY(small.amplitudes[0].maximumDisplacement < 0.2);
  QVERIFY(large.amplitudes[0].maximumDisplacement > 1.2);
}

/// With so few iterations and steps that neither Newton's method nor the ramp can succeed.
void TestDuffing::theResponseIsFollowedWhereTheRampFails() {
  harmonic::PeriodicMotionOptions options;
  options.maximumIterations = 4;
  options.maximumRampSteps = 2;
  const ResponsePoint point = solveAt(1.1, options);
  QCOMPARE(point.omega, 1.1);
  const DuffingOracle::Orbit orbit = oracle.orbit(startOf(point), point.omega);
  QVERIFY(largestDifference(point, orbit) < 1e-6);
}

QTEST_GUILESS_MAIN(TestDuffing)
#include "test_duffing.moc"
