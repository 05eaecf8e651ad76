#include <QTest>
#include <random>

#include "core/base/error.hpp"
#include "tests/core/cloth/limit_examples.hpp"

using namespace pliant::test;
using pliant::base::InputError;

namespace {

/// The worst of many admissible C by random search: anywhere first, then ever closer about the best few.
double searchOvershoot(const StretchLimit& limit, const LimitConstraints& constraints, unsigned seed) {
  const Grid grid(limit, 1800), fine(limit, 50'000);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  struct Found {
    double excess, eccentricity, doubled;
  };
  std::vector<Found> found;
  const auto tryOne = [&](double eccentricity, double doubled) {
    const Eigen::Matrix2d metric = metricOf(eccentricity, doubled);
    return Found{grid.excess(largestMultiple(constraints, metric) * metric), eccentricity, doubled};
  };
  for (int i = 0; i < 1000; ++i)
    found.push_back(tryOne(i % 2 == 0 ? 1.0 : std::sqrt(uniform(random)), 2 * pi * uniform(random)));
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.excess > b.excess; });
  double worst = 0;
  for (int start = 0; start < 4; ++start) {
    Found best = found[static_cast<std::size_t>(5 * start)];
    for (double step = 0.03; step > 1e-7; step *= 0.97) {
      const Found next =
          tryOne(std::clamp(best.eccentricity + step * normal(random), 0.0, 1.0), best.doubled + step * normal(random));
      if (next.excess > best.excess) best = next;
    }
    const Eigen::Matrix2d metric = metricOf(best.eccentricity, best.doubled);
    worst = std::max(worst, fine.excess(largestMultiple(constraints, metric) * metric));
  }
  return worst;
}

}  // namespace

class TestLimitConstraints : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void overshootOfDirectionsIsKnown() {
    for (const int count : {2, 3, 4, 7, 8, 11, 18, 90}) {
      const LimitConstraints constraints = directionConstraints(IsotropicLimit{1.01}, count);
      QCOMPARE(constraints.directions.size(), std::size_t(count));
      QVERIFY(constraints.ellipses.empty());
      const double expected = 1 / std::cos(pi / (2 * count)) - 1;
      // What counts as allowed may be 1e-9 above a bound.
      QVERIFY2(std::abs(constraints.overshoot - expected) <= 2e-9,
               qPrintable(QString::number(constraints.overshoot - expected)));
    }
    const LimitConstraints four = directionConstraints(OrthotropicLimit{1.1, 1.3, 0}, 4);
    for (int i = 0; i < 4; ++i) {
      QCOMPARE(four.directions[i].angle, pi * i / 4);
      QCOMPARE(four.directions[i].stretch, stretchAt(OrthotropicLimit{1.1, 1.3, 0}, pi * i / 4));
    }
  }

  void overshootOfDirectionsIsReachedButNeverExceeded_data() {
    QTest::addColumn<int>("limit");
    QTest::addColumn<int>("count");
    for (int limit = 0; limit < 2 + int(curves().size()); ++limit)
      for (const int count : {2, 4, 5, 8, 18})
        QTest::addRow("%s, %d",
                      limit == 0   ? "isotropic"
                      : limit == 1 ? "orthotropic"
                                   : curves()[limit - 2].name,
                      count)
            << limit << count;
  }

  void overshootOfDirectionsIsReachedButNeverExceeded() {
    QFETCH(int, limit);
    QFETCH(int, count);
    const StretchLimit stretch = limit == 0   ? StretchLimit(IsotropicLimit{1.1})
                                 : limit == 1 ? StretchLimit(OrthotropicLimit{1.05, 1.3, 0.2})
                                              : StretchLimit(LimitCurve(curves()[limit - 2].points));
    const LimitConstraints constraints = directionConstraints(stretch, count);
    const double found = searchOvershoot(stretch, constraints, 11);
    QVERIFY2(found <= constraints.overshoot + 2e-9,
             qPrintable(QString("%1 above %2").arg(found - constraints.overshoot).arg(constraints.overshoot)));
    // The search compares C by directions π / 1800 apart, which hides ½ (π / 1800)² = 1.5e-6 of C's anisotropy; the
    // limits differ by a factor of less than 1.5, and its last steps are of 1e-7.
    QVERIFY2(found >= constraints.overshoot - 5e-6,
             qPrintable(QString("%1 below %2").arg(constraints.overshoot - found).arg(constraints.overshoot)));
  }

  void ellipsesNeverUndercutTheLimit_data() {
    QTest::addColumn<int>("curve");
    QTest::addColumn<int>("count");
    for (int curve = 0; curve < int(curves().size()); ++curve)
      for (const int count : {1, 2, 3, 4, 9, 18, 90})
        QTest::addRow("%s, %d", curves()[curve].name, count) << curve << count;
  }

  void ellipsesNeverUndercutTheLimit() {
    QFETCH(int, curve);
    QFETCH(int, count);
    const StretchLimit limit = LimitCurve(curves()[curve].points);
    const LimitConstraints constraints = ellipseConstraints(limit, count);
    QCOMPARE(constraints.ellipses.size(), std::size_t(count));
    QVERIFY(constraints.directions.empty());
    const Grid grid(limit, 20'000);
    double overshoot = 0;
    for (std::size_t i = 0; i < grid.directions.size(); ++i) {
      const double squaredLimit = grid.limits[i] * grid.limits[i];
      double lowest = std::numeric_limits<double>::infinity();
      for (const Eigen::Matrix2d& s : constraints.ellipses)
        lowest = std::min(lowest, grid.directions[i].dot(s * grid.directions[i]));
      // 1e-9 is as near as a projection keeps any limit.
      QVERIFY2(lowest >= squaredLimit * (1 - 1e-9), qPrintable(QString::number(lowest / squaredLimit - 1)));
      overshoot = std::max(overshoot, std::sqrt(lowest / squaredLimit) - 1);
    }
    QVERIFY(overshoot <= constraints.overshoot + 1e-12);
    for (int k = 0; k < count; ++k) {
      const double touching = pi * k / count, stretch = stretchAt(limit, touching);
      const Eigen::Vector2d d = directionAt(touching);
      // A notch makes large numbers of which the small b² is left.
      QVERIFY(std::abs(d.dot(constraints.ellipses[k] * d) - stretch * stretch) <=
              1e-14 * constraints.ellipses[k].norm());
      QVERIFY(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(constraints.ellipses[k]).eigenvalues()[0] > 0);
    }
    const double found = searchOvershoot(limit, constraints, 12);
    QVERIFY2(found <= constraints.overshoot + 1e-12, qPrintable(QString::number(found - constraints.overshoot)));
    // One ellipse allows itself, so its bound is reached.
    if (count == 1) QVERIFY(std::abs(overshoot - constraints.overshoot) <= 1e-5);
  }

  /// Sinusoids below a sinusoid: it is itself the flattest that touches it anywhere.
  void ellipsesOfAnEllipseAreItself() {
    const OrthotropicLimit limit{1.05, 1.3, 0.2};
    const Eigen::Matrix2d exact = exactConstraints(limit).ellipses.front();
    const LimitConstraints constraints = ellipseConstraints(limit, 5);
    // The height is a quotient of differences of order 1e-8, of numbers of order 1 with errors of 1e-16.
    for (const Eigen::Matrix2d& ellipse : constraints.ellipses) QVERIFY((ellipse - exact).norm() <= 1e-6);
    QVERIFY(constraints.overshoot <= 1e-6);
  }

  void takesWhatLetsLessThrough() {
    QCOMPARE(limitConstraints(IsotropicLimit{1.1}, 7).overshoot, 0.0);
    QCOMPARE(limitConstraints(OrthotropicLimit{1.1, 1.2, 1}, 7).ellipses.size(), std::size_t(1));
    int ellipses = 0, directions = 0;
    for (const NamedCurve& named : curves())
      for (const int count : {1, 2, 4, 9, 18}) {
        const LimitCurve curve(named.points);
        const LimitConstraints chosen = limitConstraints(curve, count);
        const double byEllipses = ellipseConstraints(curve, count).overshoot;
        const double byDirections =
            count < 2 ? std::numeric_limits<double>::infinity() : directionConstraints(curve, count).overshoot;
        QCOMPARE(chosen.overshoot, std::min(byEllipses, byDirections));
        QCOMPARE(chosen.ellipses.empty(), byDirections < byEllipses);
        QCOMPARE(chosen.ellipses.size() + chosen.directions.size(), std::size_t(count));
        ++(chosen.ellipses.empty() ? directions : ellipses);
      }
    QVERIFY(ellipses > 0 && directions > 0);  // or else there would be nothing to choose
  }

  void refusesCounts() {
    const LimitCurve curve(curves()[0].points);
    for (const int count : {-1, 0, 91}) {
      QVERIFY_THROWS_EXCEPTION(InputError, ellipseConstraints(curve, count));
      QVERIFY_THROWS_EXCEPTION(InputError, directionConstraints(curve, count));
      QVERIFY_THROWS_EXCEPTION(InputError, limitConstraints(curve, count));
    }
    QVERIFY_THROWS_EXCEPTION(InputError, directionConstraints(curve, 1));
  }
};

QTEST_GUILESS_MAIN(TestLimitConstraints)
#include "test_limit_constraints.moc"
