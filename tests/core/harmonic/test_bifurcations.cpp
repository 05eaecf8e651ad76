#include <QTest>
#include <map>
#include <set>

#include "core/harmonic/frequency_response.hpp"
#include "tests/core/harmonic/example_models.hpp"
#include "tests/core/harmonic/oscillator_oracle.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::FrequencyResponse;
using harmonic::HarmonicBalanceProblem;
using harmonic::PointKind;
using harmonic::ResponsePoint;
using harmonic::StabilityState;

namespace {

constexpr int harmonics = 11;

/// One mass in the plane on hardening springs along x, along y and along the diagonal, pushed along x: two oscillators
/// that the diagonal's cubic term couples.
struct TwoOscillators {
  double secondFrequency;
  double hardening;
  double coupling;
  double damping;
  double push;
  double linearCoupling = 0;
  double secondPush = 0;

  std::shared_ptr<const Model> model() const {
    auto made = std::make_shared<Model>();
    made->dimension = 2;
    const Vector origin = vector2(0, 0);
    made->restPositions = origin;
    made->gravity = origin;
    made->lockedCoordinates = {0, 0};
    const double half = std::sqrt(0.5);
    made->energies = {
        mechanics::makeGroundedSpring(2, 0, origin, vector2(1, 0), {{1, 0, hardening}}),
        mechanics::makeGroundedSpring(2, 0, origin, vector2(0, 1), {{secondFrequency * secondFrequency, 0, hardening}}),
        mechanics::makeGroundedSpring(2, 0, origin, vector2(half, half), {{0, 0, coupling}}),
        mechanics::makeGroundedSpring(2, 0, origin, vector2(half, -half), {{linearCoupling, 0, 0}})};
    addPointMass(*made, "mass", {0}, 1);
    made->massDamping = damping;
    made->forces = {{"push", {0}, vector2(push, secondPush), cosine(1)}};
    made->finish();
    return made;
  }

  OscillatorOracle oracle() const {
    const TwoOscillators s = *this;
    const double half = std::sqrt(0.5);
    OscillatorOracle made;
    made.damping = damping;
    made.force = [=](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      const double along = half * s.coupling * std::pow(half * (x[0] + x[1]), 3);
      const double across = 0.5 * s.linearCoupling * (x[0] - x[1]);
      return Eigen::Vector2d(
          x[0] + s.hardening * std::pow(x[0], 3) + along + across,
          s.secondFrequency * s.secondFrequency * x[1] + s.hardening * std::pow(x[1], 3) + along - across);
    };
    made.stiffness = [=](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
      const double along = 1.5 * s.coupling * std::pow(half * (x[0] + x[1]), 2);
      const double across = 0.5 * s.linearCoupling;
      Eigen::Matrix2d k;
      k << 1 + 3 * s.hardening * x[0] * x[0] + along + across, along - across, along - across,
          s.secondFrequency * s.secondFrequency + 3 * s.hardening * x[1] * x[1] + along + across;
      return k;
    };
    made.drive = [=](double tau) -> Eigen::VectorXd {
      return Eigen::Vector2d(s.push * std::cos(tau), s.secondPush * std::cos(tau));
    };
    return made;
  }
};

FrequencyResponse trace(const std::shared_ptr<const Model>& model, double from, double to, int branchDepth = 0,
                        int terms = harmonics) {
  HarmonicBalanceProblem problem(model, {terms, 6 * terms});
  base::ExecutionContext context;
  harmonic::FrequencyResponseOptions options;
  options.from = from;
  options.to = to;
  options.branchDepth = branchDepth;
  return harmonic::traceFrequencyResponse(problem, options, context);
}

bool isBifurcation(const ResponsePoint& point) {
  return point.kind != PointKind::regular && point.kind != PointKind::peak;
}

/// How far the motion through a point's start is from where it was after a period of the point's series.
double periodicityError(const OscillatorOracle& oracle, const ResponsePoint& point, int terms = harmonics) {
  const Eigen::VectorXd start = startOfSeries(point.z, point.drivePeriods * terms, point.omega / point.drivePeriods);
  Eigen::VectorXd end = start;
  for (int period = 0; period < point.drivePeriods; ++period) end = oracle.period(end, point.omega);
  return (end - start).norm();
}

}  // namespace

/// Bifurcations of response curves, and the curves that branch off, against direct integration.
class TestBifurcations : public QObject {
  Q_OBJECT

 private slots:
  void stabilityNearAThreeToOneResonanceAgreesWithIntegration_data();
  void stabilityNearAThreeToOneResonanceAgreesWithIntegration();
  void disturbancesOnBothSidesOfEachBifurcationBehaveAsFound();
  void theBranchOfUnequalMotionsIsFollowed();
};

void TestBifurcations::stabilityNearAThreeToOneResonanceAgreesWithIntegration_data() {
  QTest::addColumn<double>("second");
  QTest::addColumn<double>("hardening");
  QTest::addColumn<double>("push");
  QTest::addColumn<double>("to");
  QTest::addColumn<int>("tori");
  QTest::addColumn<int>("branchPoints");
  QTest::addColumn<int>("folds");
  QTest::newRow("two Neimark-Sacker points") << 3.2 << 0.5 << 0.03 << 2.2 << 2 << 0 << 2;
  QTest::newRow("branch points and an isle of instability") << 3.3 << 0.3 << 0.05 << 2.5 << 1 << 4 << 6;
}

void TestBifurcations::stabilityNearAThreeToOneResonanceAgreesWithIntegration() {
  QFETCH(double, second);
  QFETCH(double, hardening);
  QFETCH(double, push);
  QFETCH(double, to);
  QFETCH(int, tori);
  QFETCH(int, branchPoints);
  QFETCH(int, folds);
  const TwoOscillators system{second, hardening, 1, 0.01, push};
  const OscillatorOracle oracle = system.oracle();
  const FrequencyResponse response = trace(system.model(), 0.8, to);
  QVERIFY(response.report.converged());
  std::map<PointKind, int> counts;
  for (const ResponsePoint& point : response.points) {
    ++counts[point.kind];
    QVERIFY(point.stability.state != StabilityState::unknown);
    const Eigen::VectorXd start = startOfSeries(point.z, harmonics, point.omega);
    const auto expected = oracle.multipliers(start, point.omega);
    if (!isBifurcation(point)) {
      QCOMPARE(point.stability.unstableCount, oracle.unstableCount(start, point.omega));
      QVERIFY(distanceBetween(point.stability.multipliers, expected) < 1e-3);
    } else if (point.kind != PointKind::fold) {
      // A multiplier on the unit circle, by integration as well.
      double nearest = 1;
      for (const auto multiplier : expected) nearest = std::min(nearest, std::abs(std::abs(multiplier) - 1));
      QVERIFY2(nearest < 1e-4, qPrintable(QString("%1 at %2").arg(nearest).arg(point.omega)));
    }
  }
  QCOMPARE(counts[PointKind::neimarkSacker], tori);
  QCOMPARE(counts[PointKind::branchPoint], branchPoints);
  QCOMPARE(counts[PointKind::fold], folds);
  QCOMPARE(counts[PointKind::periodDoubling], 0);
}

void TestBifurcations::disturbancesOnBothSidesOfEachBifurcationBehaveAsFound() {
  const TwoOscillators system{3.2, 0.5, 1, 0.01, 0.03};
  OscillatorOracle oracle = system.oracle();
  oracle.steps = 400;
  const auto points = trace(system.model(), 0.8, 2.2).points;
  int checked = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!isBifurcation(points[i])) continue;
    // The nearest points on either side whose disturbances change enough to be told within some hundred periods.
    for (const int direction : {-1, 1}) {
      for (auto j = static_cast<long>(i) + direction; j >= 0 && j < static_cast<long>(points.size()); j += direction) {
        const ResponsePoint& point = points[static_cast<std::size_t>(j)];
        const double largest = std::abs(point.stability.multipliers.empty() ? 1.0 : point.stability.multipliers[0]);
        if (isBifurcation(point) || std::abs(largest - 1) < 0.008) continue;
        const Eigen::VectorXd start = oracle.orbit(startOfSeries(point.z, harmonics, point.omega), point.omega);
        Eigen::VectorXd disturbed = start + 1e-5 * Eigen::Vector4d(1, 1, -1, 1);
        for (int period = 0; period < 600; ++period) disturbed = oracle.period(disturbed, point.omega);
        QCOMPARE((disturbed - start).norm() < 5e-6, point.stability.state == StabilityState::stable);
        ++checked;
        break;
      }
    }
  }
  QCOMPARE(checked, 8);
}

void TestBifurcations::theBranchOfUnequalMotionsIsFollowed() {
  // Two equal oscillators, weakly coupled and pushed alike: where they swing far, they may swing unequally.
  const TwoOscillators system{1, 0.5, 0, 0.05, 0.2, 0.1, 0.2};
  const OscillatorOracle oracle = system.oracle();
  const FrequencyResponse first = trace(system.model(), 0.8, 2.2);
  const FrequencyResponse response = trace(system.model(), 0.8, 2.2, 1);
  QVERIFY2(response.report.converged(), response.report.message.c_str());
  int onFirst = 0, branchPoints = 0, unequal = 0, stable = 0, unstable = 0;
  std::set<int> branches;
  for (const ResponsePoint& point : response.points) {
    branches.insert(point.branch);
    const Eigen::Index width = 2 * harmonics + 1;
    const double difference = (point.z.head(width) - point.z.tail(width)).norm();
    QVERIFY(periodicityError(oracle, point) < 1e-4);
    if (point.branch == 0) {
      ++onFirst;
      branchPoints += point.kind == PointKind::branchPoint;
      QVERIFY(difference < 1e-6);
      continue;
    }
    if (difference > 1e-3) ++unequal;
    if (isBifurcation(point)) continue;
    if (difference < 1e-3) continue;
    const int count = oracle.unstableCount(startOfSeries(point.z, harmonics, point.omega), point.omega);
    QCOMPARE(point.stability.unstableCount, count);
    ++(count > 0 ? unstable : stable);
  }
  QCOMPARE(onFirst, static_cast<int>(first.points.size()));
  QVERIFY(branchPoints >= 2);
  QVERIFY(branches.size() >= 2);
  QVERIFY(unequal > 10);
  QVERIFY(unstable > 0);
}

QTEST_GUILESS_MAIN(TestBifurcations)
#include "test_bifurcations.moc"
