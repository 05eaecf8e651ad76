#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <limits>
#include <random>

#include "core/geometry/continuous_collision.hpp"

using namespace pliant::geometry;
using Eigen::Vector3d;

namespace {

Corners randomCorners(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> coordinate(-size, size);
  return Corners::NullaryExpr([&] { return coordinate(random); });
}

/// Whether the segment p q passes strictly through the triangle, by volumes.
double volume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// All times in (0, 1) at which the four corners lie in one plane: roots of a cubic, by sampling and bisection. Pairs
/// of roots nearer than 1/n are missed.
std::vector<double> coplanarTimes(const Corners& x, const Corners& motion) {
  const auto at = [&](double t) {
    const Corners now = x + t * motion;
    return volume(now.col(0), now.col(1), now.col(2), now.col(3));
  };
  constexpr int n = 400;
  std::vector<double> times;
  for (int i = 0; i < n; ++i) {
    double low = double(i) / n, high = double(i + 1) / n;
    const bool negative = at(low) < 0;
    if ((at(high) < 0) == negative) continue;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      ((at(middle) < 0) == negative ? low : high) = middle;
    }
    times.push_back(high);
  }
  return times;
}

/// The first time at which point and triangle, or two edges, meet, independent of distances and advancement: among the
/// times at which they lie in one plane, the first at which the crossing is inside both. Infinite if none.
double meetingTime(SimplexPair pair, const Corners& x, const Corners& motion) {
  for (const double t : coplanarTimes(x, motion)) {
    const Corners now = x + t * motion;
    const Vector3d p = now.col(0), a = now.col(1), b = now.col(2), c = now.col(3);
    if (pair == SimplexPair::pointTriangle) {
      const Vector3d n = (b - a).cross(c - a);
      if ((b - a).cross(p - a).dot(n) > 0 && (c - b).cross(p - b).dot(n) > 0 && (a - c).cross(p - c).dot(n) > 0)
        return t;
    } else {
      const Vector3d n = (a - p).cross(c - b);  // edges p a and b c
      const bool first = (a - p).cross(b - p).dot(n) * (a - p).cross(c - p).dot(n) < 0;
      const bool second = (c - b).cross(p - b).dot(n) * (c - b).cross(a - b).dot(n) < 0;
      if (first && second) return t;
    }
  }
  return std::numeric_limits<double>::infinity();
}

double distanceAt(SimplexPair pair, const Corners& x, const Corners& motion, double t) {
  return std::sqrt(closestPoints(pair, x + t * motion).squaredDistance);
}

}  // namespace

class TestContinuousCollision : public QObject {
  Q_OBJECT

 private slots:
  void headOn_data();
  void headOn();
  void slidingPastEachOther();
  void keptGapGoesFurther();
  void neverMissesAMeeting_data();
  void neverMissesAMeeting();
  void separationIsKept_data();
  void separationIsKept();
  void commonMotionDoesNotCount();
  void tinyGapsAndFastMotion();
  void withoutMotionOrGap();
};

void TestContinuousCollision::headOn_data() {
  QTest::addColumn<double>("separation");
  QTest::newRow("touching") << 0.0;
  QTest::newRow("apart") << 0.25;
}

void TestContinuousCollision::headOn() {
  QFETCH(double, separation);
  // From height 1 with speed 2 or -2 against the rest: they are `separation` apart at (1 - separation)/2.
  const double meeting = (1 - separation) / 2, keptGap = 0.1 * meeting;
  Corners motion = Corners::Zero();
  motion(2, 0) = -2;
  Corners point, edges;
  point << 0.2, 0, 1, 0, 0.2, 0, 0, 1, 1, 0, 0, 0;
  edges << 0, 0, -1, 1, -1, 1, 0, 0, 1, 1, 0, 0;
  const double fraction = safeFraction(SimplexPair::pointTriangle, point, motion, separation);
  QVERIFY(fraction < meeting && fraction >= meeting - keptGap - 1e-15);
  motion(2, 1) = -2;
  const double ofEdges = safeFraction(SimplexPair::edgeEdge, edges, motion, separation);
  QVERIFY(ofEdges < meeting && ofEdges >= meeting - keptGap - 1e-15);
  QCOMPARE(safeFraction(SimplexPair::edgeEdge, edges, -motion, separation), 1.0);
  QCOMPARE(safeFraction(SimplexPair::edgeEdge, edges, 0.4 * (1 - separation) * motion, separation), 1.0);
  QCOMPARE(safeFraction(SimplexPair::edgeEdge, edges, motion, separation, 0.25), 0.25);
  // Two points, and a point and an edge.
  Corners apart = Corners::Zero();
  apart(2, 0) = 1;
  apart(0, 2) = 1;
  motion(2, 1) = 0;
  for (const SimplexPair pair : {SimplexPair::pointPoint, SimplexPair::pointEdge}) {
    const double ofPoints = safeFraction(pair, apart, motion, separation);
    QVERIFY(ofPoints < meeting && ofPoints >= meeting - keptGap - 1e-15);
  }
}

void TestContinuousCollision::slidingPastEachOther() {
  // Along the plane at a distance that is small against the path: nothing is met.
  Corners point;
  point << 0, -1, 1, 0, 0.3, 0, 0, 1, 1e-6, 0, 0, 0;
  Corners motion = Corners::Zero();
  motion(0, 0) = 2;
  QCOMPARE(safeFraction(SimplexPair::pointTriangle, point, motion, 0), 1.0);
  motion(2, 0) = -0.5e-6;
  QCOMPARE(safeFraction(SimplexPair::pointTriangle, point, motion, 0), 1.0);
  motion(2, 0) = -1e-5;  // meets the triangle at x = 0.2
  const double fraction = safeFraction(SimplexPair::pointTriangle, point, motion, 0);
  QVERIFY(fraction >= 0.09 && fraction < 0.1);
}

void TestContinuousCollision::keptGapGoesFurther() {
  // Comes to rest at a hundredth of its height, less than the tenth that ends the search otherwise.
  Corners point;
  point << 0.2, 0, 1, 0, 0.2, 0, 0, 1, 1, 0, 0, 0;
  Corners motion = Corners::Zero();
  motion(2, 0) = -0.99;
  QCOMPARE(safeFraction(SimplexPair::pointTriangle, point, motion, 0, 1, 1e-3), 1.0);
  motion(2, 0) = -2;
  const double fraction = safeFraction(SimplexPair::pointTriangle, point, motion, 0, 1, 1e-3);
  QVERIFY(fraction < 0.5 && fraction >= 0.4995);
}

void TestContinuousCollision::neverMissesAMeeting_data() {
  QTest::addColumn<int>("pair");
  QTest::addColumn<double>("speed");
  for (const double speed : {0.3, 1.0, 10.0}) {
    QTest::addRow("point and triangle, %g", speed) << static_cast<int>(SimplexPair::pointTriangle) << speed;
    QTest::addRow("edges, %g", speed) << static_cast<int>(SimplexPair::edgeEdge) << speed;
  }
}

void TestContinuousCollision::neverMissesAMeeting() {
  QFETCH(int, pair);
  QFETCH(double, speed);
  const auto kind = static_cast<SimplexPair>(pair);
  std::mt19937 random(static_cast<unsigned>(pair) + 10);
  int meetings = 0;
  for (int trial = 0; trial < 12000; ++trial) {
    const Corners x = randomCorners(random, 1), motion = randomCorners(random, speed);
    const double fraction = safeFraction(kind, x, motion, 0);
    QVERIFY(fraction > 0 && fraction <= 1);
    const double meeting = meetingTime(kind, x, motion);
    QVERIFY2(fraction < meeting, qPrintable(QString("trial %1: %2, but %3").arg(trial).arg(fraction).arg(meeting)));
    // Not without need: either the end, or a tenth of the gap is left.
    const double gap = distanceAt(kind, x, motion, 0), left = distanceAt(kind, x, motion, fraction);
    QVERIFY(fraction == 1 || left <= 0.1 * gap * (1 + 1e-9));
    QVERIFY(left >= 0.0099 * gap);
    if (meeting <= 1) ++meetings;
  }
  QVERIFY(meetings > 100);
}

void TestContinuousCollision::separationIsKept_data() { neverMissesAMeeting_data(); }

void TestContinuousCollision::separationIsKept() {
  QFETCH(int, pair);
  QFETCH(double, speed);
  const auto kind = static_cast<SimplexPair>(pair);
  std::mt19937 random(static_cast<unsigned>(pair) + 20);
  constexpr double separation = 0.05;
  constexpr int samples = 500;
  int stopped = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Corners x = randomCorners(random, 1), motion = randomCorners(random, speed);
    const double gap = distanceAt(kind, x, motion, 0) - separation;
    const double fraction = safeFraction(kind, x, motion, separation);
    if (gap <= 0) {
      QCOMPARE(fraction, 0.0);
      continue;
    }
    for (int i = 0; i <= samples; ++i) QVERIFY(distanceAt(kind, x, motion, fraction * i / samples) > separation);
    if (fraction == 1) continue;
    ++stopped;
    QVERIFY(distanceAt(kind, x, motion, fraction) - separation <= 0.1 * gap * (1 + 1e-9));
  }
  QVERIFY(stopped > 20);
}

void TestContinuousCollision::commonMotionDoesNotCount() {
  std::mt19937 random(30);
  for (int trial = 0; trial < 200; ++trial) {
    const Corners x = randomCorners(random, 1);
    Corners motion;
    motion.colwise() = Vector3d(100, -20, 7);
    QCOMPARE(safeFraction(SimplexPair::pointTriangle, x, motion, 0), 1.0);
  }
}

void TestContinuousCollision::tinyGapsAndFastMotion() {
  for (const double gap : {1e-3, 1e-6, 1e-9}) {
    Corners point;
    point << 0.2, 0, 1, 0, 0.2, 0, 0, 1, gap, 0, 0, 0;
    Corners motion = Corners::Zero();
    motion.col(0) << 3, 2, -1;
    const double fraction = safeFraction(SimplexPair::pointTriangle, point, motion, 0);
    QVERIFY(fraction < gap && fraction >= 0.9 * gap * (1 - 1e-6));
    QVERIFY((point + fraction * motion)(2, 0) > 0);
  }
}

void TestContinuousCollision::withoutMotionOrGap() {
  Corners point;
  point << 0.2, 0, 1, 0, 0.2, 0, 0, 1, 1, 0, 0, 0;
  QCOMPARE(safeFraction(SimplexPair::pointTriangle, point, Corners::Zero(), 0), 1.0);
  QCOMPARE(safeFraction(SimplexPair::pointTriangle, point, Corners::Zero(), 1), 0.0);
  Corners invalid = Corners::Zero();
  invalid(1, 1) = std::numeric_limits<double>::quiet_NaN();
  QCOMPARE(safeFraction(SimplexPair::pointTriangle, point, invalid, 0), 0.0);
  QCOMPARE(safeFraction(SimplexPair::pointTriangle, invalid, Corners::Zero(), 0), 0.0);
  point(2, 0) = 0;
  QCOMPARE(safeFraction(SimplexPair::pointTriangle, point, Corners::Ones(), 0), 0.0);
}

QTEST_GUILESS_MAIN(TestContinuousCollision)
#include "test_continuous_collision.moc"
