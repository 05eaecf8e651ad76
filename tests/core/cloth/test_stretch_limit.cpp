#include <Eigen/Geometry>
#include <QTest>
#include <random>

#include "core/base/error.hpp"
#include "tests/core/cloth/limit_examples.hpp"

using namespace pliant::test;
using pliant::base::InputError;

class TestStretchLimit : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void curveGoesThroughItsPoints() {
    for (const auto& [name, points] : curves()) {
      const LimitCurve curve(points);
      for (const DirectionLimit& point : points)
        for (const double turns : {-3.0, -1.0, 0.0, 1.0, 2.0}) {
          // The angle itself is rounded, by about 1e-15 after a few turns; the curves are flat or sloped by up to 400.
          const double got = curve(point.angle + turns * pi);
          QVERIFY2(std::abs(got - point.stretch) <= 1e-12,
                   qPrintable(QString("%1 %2 %3").arg(name).arg(point.angle / degree).arg(got - point.stretch)));
        }
    }
  }

  void curveMakesNoNewExtrema() {
    for (const auto& [name, points] : curves()) {
      const LimitCurve curve(points);
      const std::vector<DirectionLimit>& sorted = curve.points();
      double smallest = sorted[0].stretch;
      for (std::size_t i = 0; i < sorted.size(); ++i) {
        const bool last = i + 1 == sorted.size();
        const double begin = sorted[i].angle, end = last ? sorted[0].angle + pi : sorted[i + 1].angle;
        const double rise = (last ? sorted[0] : sorted[i + 1]).stretch - sorted[i].stretch;
        double before = sorted[i].stretch;
        for (int k = 1; k <= 1000; ++k) {
          const double now = curve(begin + (end - begin) * k / 1000);
          QVERIFY2(rise > 0 ? now >= before - 1e-14 : now <= before + 1e-14, name);
          if (rise == 0) QVERIFY(std::abs(now - sorted[i].stretch) <= 1e-14);
          smallest = std::min(smallest, now);
          before = now;
        }
      }
      QVERIFY(std::abs(smallestStretch(curve) - smallest) <= 1e-14);
    }
  }

  void slopeAndCurvatureAreDerivatives() {
    for (const auto& [name, points] : curves()) {
      const LimitCurve curve(points);
      double width = pi, height = 0;
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        width = std::min(width, curve.points()[i + 1].angle - curve.points()[i].angle);
        height = std::max(height, std::abs(curve.points()[i + 1].stretch - curve.points()[i].stretch));
      }
      // Of a cubic with such slopes the second derivative is at most 6 height / width² and the third 12 height /
      // width³, so that central differences over h are off by at most h times the second, also across a point, or h
      // times the third inside a piece; a hundredth is left for rounding.
      const double h = 1e-4 * width, curvature = 6 * height / (width * width), jerk = 2 * curvature / width;
      for (const double angle : fineAngles(curve, 997)) {
        QVERIFY(std::abs(curve.slope(angle) - (curve(angle + h) - curve(angle - h)) / (2 * h)) <= 1.01 * h * curvature);
        QVERIFY(std::abs(curve.slope(angle + h) - curve.slope(angle - h)) <= 2.01 * h * curvature);
        const bool nearPoint = std::any_of(points.begin(), points.end(), [&](const DirectionLimit& point) {
          return std::abs(std::sin(angle - point.angle)) <= 1.5 * h;
        });
        if (nearPoint) continue;
        const double numeric = (curve.slope(angle + h) - curve.slope(angle - h)) / (2 * h);
        QVERIFY2(std::abs(curve.curvature(angle) - numeric) <= 1.01 * h * jerk, name);
      }
    }
  }

  void onePointIsTheSameInEveryDirection() {
    const LimitCurve curve({{0.7, 1.13}});
    for (int i = -50; i < 50; ++i) QCOMPARE(curve(0.1 * i), 1.13);
    QCOMPARE(smallestStretch(curve), 1.13);
  }

  void pointsMayComeInAnyOrder() {
    std::vector<DirectionLimit> points = curves()[1].points;
    const LimitCurve sorted(points);
    std::swap(points[0], points[4]);
    std::swap(points[1], points[2]);
    points[3].angle -= 2 * pi;
    const LimitCurve mixed(points);
    // The same but for the rounding of one angle.
    for (int i = 0; i < 100; ++i) QVERIFY(std::abs(sorted(0.05 * i) - mixed(0.05 * i)) <= 1e-14);
  }

  void refusesBadCurves_data() {
    QTest::addColumn<std::vector<double>>("numbers");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    QTest::newRow("no point") << std::vector<double>{};
    QTest::newRow("angle is not a number") << std::vector<double>{nan, 1};
    QTest::newRow("stretch is not a number") << std::vector<double>{0, 1, 1, nan};
    QTest::newRow("infinite") << std::vector<double>{0, std::numeric_limits<double>::infinity()};
    QTest::newRow("zero") << std::vector<double>{0, 0};
    QTest::newRow("negative") << std::vector<double>{0, 1, 1, -1};
    QTest::newRow("twice") << std::vector<double>{0.5, 1, 0.2, 1, 0.5, 1.1};
    QTest::newRow("opposite") << std::vector<double>{0.5, 1, 0.5 + pi, 1.1};
    QTest::newRow("three half turns on") << std::vector<double>{0, 1, 3 * pi, 1.1};
    QTest::newRow("opposite but for rounding") << std::vector<double>{0, 1, std::nextafter(pi, 0), 1.1};
    QTest::newRow("opposite but for rounding, below 0") << std::vector<double>{0, 1, -1e-13, 1.1};
  }

  void refusesBadCurves() {
    QFETCH(std::vector<double>, numbers);
    std::vector<DirectionLimit> points;
    for (std::size_t i = 0; i < numbers.size(); i += 2) points.push_back({numbers[i], numbers[i + 1]});
    QVERIFY_THROWS_EXCEPTION(InputError, LimitCurve{points});
  }

  void orthotropicIsAHomogeneousStretch() {
    const OrthotropicLimit limit{1.05, 1.4, 0.3};
    const Eigen::Matrix2d map = Eigen::Vector2d(1.05, 1.4).asDiagonal() * Eigen::Rotation2Dd(-0.3).toRotationMatrix();
    for (int i = 0; i < 100; ++i) {
      const double angle = 0.1 * i - 3;
      QVERIFY(std::abs(stretchAt(limit, angle) - (map * directionAt(angle)).norm()) <= 1e-15 * 4);
    }
    QCOMPARE(smallestStretch(limit), 1.05);
    QCOMPARE(smallestStretch(OrthotropicLimit{1.2, 0.9, 2}), 0.9);
    QCOMPARE(smallestStretch(IsotropicLimit{1.01}), 1.01);
  }

  /// A random C, scaled until by brute force its worst direction is at the limit, is at the limit of the ellipse.
  void ellipseIsExact() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const StretchLimit& limit : std::vector<StretchLimit>{
             IsotropicLimit{1.07}, OrthotropicLimit{1.02, 1.5, 0.4}, OrthotropicLimit{1.3, 0.8, -2}}) {
      const LimitConstraints constraints = exactConstraints(limit);
      QCOMPARE(constraints.ellipses.size(), std::size_t(1));
      QVERIFY(constraints.directions.empty());
      QCOMPARE(constraints.overshoot, 0.0);
      const int count = 20'000;
      const Grid grid(limit, count);
      for (int i = 0; i < 100; ++i) {
        const Eigen::Matrix2d metric = metricOf(i % 4 == 0 ? 1.0 : uniform(random), 2 * pi * uniform(random));
        const double byDirections = 1 / std::pow(1 + grid.excess(metric), 2);
        // dᵀCd / dᵀSd between directions π / count apart is above theirs by ½ (π / 2 count)² times its second
        // derivative, which is at most 4 (b₂/b₁)² of it.
        const double error = 2 * std::pow(1.5 / 0.8 * 1.5, 2) * std::pow(pi / (2 * count), 2);
        QVERIFY(std::abs(largestMultiple(constraints, metric) / byDirections - 1) <= error);
      }
    }
    QVERIFY_THROWS_EXCEPTION(std::bad_variant_access, exactConstraints(LimitCurve({{0, 1}})));
  }
};

QTEST_GUILESS_MAIN(TestStretchLimit)
#include "test_stretch_limit.moc"
