#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <map>
#include <random>

#include "tests/core/geometry/corner_differences.hpp"

using namespace pliant::geometry;
using Eigen::Vector3d;

namespace {

constexpr std::array allPairs = {
    SimplexPair::pointPoint, SimplexPair::pointEdge, SimplexPair::pointTriangle, SimplexPair::edgeEdge};

/// Which corners have a part in the distance, as bits.
int regionOf(const ClosestPoints& closest) {
  int region = 0;
  for (int i = 0; i < 4; ++i)
    if (closest.weights[i] != 0) region |= 1 << i;
  return region;
}

/// The point of a segment or triangle (columns) at barycentric coordinates that are cut off at its sides.
using Simplex = Eigen::Matrix3Xd;

std::pair<Simplex, Simplex> simplicesOf(SimplexPair pair, const Corners& corners) {
  const int first = firstCornerCount(pair);
  return {corners.leftCols(first), corners.middleCols(first, cornerCount(pair) - first)};
}

/// All barycentric coordinates in steps of 1/n.
std::vector<Eigen::VectorXd> samplesOf(Eigen::Index corners, int n) {
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i <= n; ++i) {
    const double s = double(i) / n;
    if (corners == 1 && i == 0) samples.push_back(Eigen::VectorXd::Ones(1));
    if (corners == 2) samples.push_back(Eigen::Vector2d(1 - s, s));
    for (int j = 0; corners == 3 && i + j <= n; ++j)
      samples.push_back(Vector3d(double(n - i - j) / n, s, double(j) / n));
  }
  return samples;
}

/// The smallest distance of sampled points, which is above the true one, by at most the diameters over n.
double sampledDistance(const Simplex& a, const Simplex& b, int n) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& u : samplesOf(a.cols(), n))
    for (const auto& v : samplesOf(b.cols(), n)) smallest = std::min(smallest, (a * u - b * v).norm());
  return smallest;
}

/// Closest points are closest if and only if no corner lies farther along r than they do (for convex sets).
void verifyOptimality(SimplexPair pair, const Corners& corners, const ClosestPoints& closest) {
  const int first = firstCornerCount(pair), all = cornerCount(pair);
  QVERIFY(std::abs(closest.weights.head(first).sum() - 1) < 1e-12);
  QVERIFY(std::abs(closest.weights.segment(first, all - first).sum() + 1) < 1e-12);
  QVERIFY(closest.weights.head(first).minCoeff() >= 0 && closest.weights.tail(4 - first).maxCoeff() <= 0);
  Vector3d pointA = Vector3d::Zero(), pointB = Vector3d::Zero();
  for (int i = 0; i < all; ++i) (i < first ? pointA : pointB) += std::abs(closest.weights[i]) * corners.col(i);
  const Vector3d r = pointA - pointB;
  QVERIFY(std::abs(r.squaredNorm() - closest.squaredDistance) <= 1e-12);
  for (int i = 0; i < all; ++i) {
    const double excess = i < first ? r.dot(pointA - corners.col(i)) : r.dot(corners.col(i) - pointB);
    QVERIFY2(excess <= 1e-10, qPrintable(QString::number(excess)));
  }
}

}  // namespace

class TestSimplexDistance : public QObject {
  Q_OBJECT

 private slots:
  void closedForms();
  void closestPointsAreOptimal();
  void distancesMatchSamples();
  void degenerateSimplices();
  void nearlyParallelEdges();
  void derivativesInEveryRegion();
  void gradientIsContinuousAcrossRegions();
};

void TestSimplexDistance::closedForms() {
  Corners corners;
  corners << 0.3, 0, 1, 0, 0.3, 0, 0, 1, -2, 0, 0, 0;
  const ClosestPoints inside = closestPoints(SimplexPair::pointTriangle, corners);
  QCOMPARE(inside.squaredDistance, 4.0);
  QVERIFY((inside.weights - Eigen::Vector4d(1, -0.4, -0.3, -0.3)).norm() < 1e-15);
  corners.col(0) << 2, 2, 1;  // over the slanted side
  QVERIFY(std::abs(closestPoints(SimplexPair::pointTriangle, corners).squaredDistance - (4.5 + 1)) < 1e-14);
  corners << -1, 3, 0, 0, 0, 0, -2, 2, 0, 0, 0.5, 0.5;  // a cross
  const ClosestPoints crossing = closestPoints(SimplexPair::edgeEdge, corners);
  QCOMPARE(crossing.squaredDistance, 0.25);
  QVERIFY((crossing.weights - Eigen::Vector4d(0.75, 0.25, -0.5, -0.5)).norm() < 1e-15);
}

void TestSimplexDistance::closestPointsAreOptimal() {
  std::mt19937 random(1);
  std::map<SimplexPair, std::map<int, int>> regions;
  for (const SimplexPair pair : allPairs)
    for (int trial = 0; trial < 20000; ++trial) {
      Corners corners = randomCorners(random);
      if (trial % 2) corners.row(2) *= 0.05;  // rather flat, so that all regions occur
      const ClosestPoints closest = closestPoints(pair, corners);
      verifyOptimality(pair, corners, closest);
      if (QTest::currentTestFailed()) return;
      ++regions[pair][regionOf(closest)];
    }
  const std::array<std::size_t, 4> expected = {1, 3, 7, 9};
  for (const SimplexPair pair : allPairs) {
    QCOMPARE(regions[pair].size(), expected[static_cast<int>(pair)]);
    for (const auto& [region, count] : regions[pair]) QVERIFY(count >= 50);
  }
}

void TestSimplexDistance::distancesMatchSamples() {
  std::mt19937 random(2);
  constexpr int n = 40;
  for (const SimplexPair pair : allPairs)
    for (int trial = 0; trial < 100; ++trial) {
      const Corners corners = randomCorners(random);
      const auto [a, b] = simplicesOf(pair, corners);
      const double distance = std::sqrt(closestPoints(pair, corners).squaredDistance);
      const double sampled = sampledDistance(a, b, n);
      QVERIFY(distance <= sampled + 1e-12);
      QVERIFY(sampled <= distance + 2 * 2 * std::sqrt(12.0) / n);  // no edge is longer than a diagonal
    }
}

void TestSimplexDistance::degenerateSimplices() {
  std::mt19937 random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    const Corners base = randomCorners(random);
    std::vector<Corners> examples(6, base);
    examples[0].col(3) = base.col(2);                                      // the last edge is a point
    examples[1].col(3) = examples[1].col(1) = base.col(2);                 // triangle is a point
    examples[2].col(3) = base.col(2) + 0.3 * (base.col(1) - base.col(2));  // triangle is a line
    examples[3].col(3) = base.col(2) + (base.col(1) - base.col(0));        // edges are parallel
    examples[4].col(2) = base.col(0) + 0.3 * (base.col(1) - base.col(0));  // and on one line
    examples[4].col(3) = base.col(0) + 1.7 * (base.col(1) - base.col(0));
    examples[5].col(1) = base.col(0), examples[5].col(3) = base.col(2);  // two points
    for (const Corners& corners : examples)
      for (const SimplexPair pair : {SimplexPair::pointEdge, SimplexPair::pointTriangle, SimplexPair::edgeEdge}) {
        verifyOptimality(pair, corners, closestPoints(pair, corners));
        if (QTest::currentTestFailed()) return;
      }
  }
}

void TestSimplexDistance::nearlyParallelEdges() {
  // Turned by an angle about their middles, at distance 0.1: the distance is 0.1 whatever the angle.
  for (double angle = 1; angle > 1e-12; angle *= 0.5) {
    Corners corners;
    corners << -1, 1, -std::cos(angle), std::cos(angle), 0, 0, -std::sin(angle), std::sin(angle), 0, 0, 0.1, 0.1;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const ClosestPoints closest = closestPoints(SimplexPair::edgeEdge, turn * corners);
    QVERIFY(std::abs(std::sqrt(closest.squaredDistance) - 0.1) < 1e-14);
    const double error = (closest.weights - Eigen::Vector4d(0.5, 0.5, -0.5, -0.5)).norm();
    if (angle > 1e-5) QVERIFY(error < 1e-15 + 1e-15 / (angle * angle));
    // Nearer than the ends are to the other edge: missing the crossing would be seen.
    corners.rightCols(2).row(2).setConstant(1e-9);
    if (angle > 1e-10)
      QVERIFY(std::abs(std::sqrt(closestPoints(SimplexPair::edgeEdge, turn * corners).squaredDistance) - 1e-9) < 1e-14);
  }
}

void TestSimplexDistance::derivativesInEveryRegion() {
  std::mt19937 random(4);
  constexpr double step = 1e-5;
  std::map<SimplexPair, std::map<int, int>> regions;
  for (const SimplexPair pair : allPairs)
    for (int trial = 0; trial < 3000; ++trial) {
      Corners corners = randomCorners(random);
      if (trial % 2) corners.row(2) *= 0.2;
      const ClosestPoints closest = closestPoints(pair, corners);
      // Differences are valid inside a region only, and accurate only away from singular triangles and edges.
      const auto [a, b] = simplicesOf(pair, corners);
      const Vector3d side = corners.col(2) - corners.col(1);
      if (pair == SimplexPair::edgeEdge &&
          (corners.col(1) - corners.col(0)).cross(corners.col(3) - corners.col(2)).norm() < 0.2)
        continue;
      if (pair == SimplexPair::pointTriangle && side.cross(corners.col(3) - corners.col(1)).norm() < 0.2) continue;
      if (pair == SimplexPair::pointEdge && side.norm() < 0.2) continue;
      bool inside = true;
      for (int i = 0; i < 24; ++i) {
        Corners moved = corners;
        moved.reshaped()[i % 12] += i < 12 ? step : -step;
        inside = inside && regionOf(closestPoints(pair, moved)) == regionOf(closest);
      }
      if (!inside) continue;
      const auto value = [&](const Corners& x) { return closestPoints(pair, x).squaredDistance; };
      const auto slope = [&](const Corners& x) {
        CornerVector gradient;
        squaredDistanceDerivatives(x, closestPoints(pair, x), &gradient, nullptr);
        return gradient;
      };
      CornerVector gradient;
      CornerMatrix hessian;
      squaredDistanceDerivatives(corners, closest, &gradient, &hessian);
      // Third derivatives are below some 1e4 here: differences err by step² times that.
      const CornerVector expected = gradientByDifferences(value, corners, step);
      QVERIFY2((gradient - expected).norm() <= 1e-7, qPrintable(QString::number((gradient - expected).norm())));
      const CornerMatrix expectedHessian = hessianByDifferences(slope, corners, step);
      QVERIFY2((hessian - expectedHessian).norm() <= 1e-5 * std::max(1.0, expectedHessian.norm()),
               qPrintable(QString::number((hessian - expectedHessian).norm())));
      QVERIFY((hessian - hessian.transpose()).norm() <= 1e-12 * hessian.norm());
      ++regions[pair][regionOf(closest)];
    }
  const std::array<std::size_t, 4> expected = {1, 3, 7, 9};
  for (const SimplexPair pair : allPairs) {
    QCOMPARE(regions[pair].size(), expected[static_cast<int>(pair)]);
    for (const auto& [region, count] : regions[pair]) QVERIFY(count >= 10);
  }
}

void TestSimplexDistance::gradientIsContinuousAcrossRegions() {
  // Along random lines the gradient changes by no more than a bound times the step, also where regions change.
  std::mt19937 random(5);
  int changes = 0;
  for (const SimplexPair pair : {SimplexPair::pointEdge, SimplexPair::pointTriangle, SimplexPair::edgeEdge})
    for (int trial = 0; trial < 2000; ++trial) {
      const Corners from = randomCorners(random), direction = randomCorners(random);
      // The two regions on both sides of the first change, found by bisection.
      double low = 0, high = 1;
      const auto at = [&](double t) -> Corners { return from + t * direction; };
      const int region = regionOf(closestPoints(pair, at(0)));
      if (regionOf(closestPoints(pair, at(1))) == region) continue;
      while (high - low > 1e-10) {
        const double middle = 0.5 * (low + high);
        (regionOf(closestPoints(pair, at(middle))) == region ? low : high) = middle;
      }
      CornerVector before, after;
      squaredDistanceDerivatives(at(low), closestPoints(pair, at(low)), &before, nullptr);
      squaredDistanceDerivatives(at(high), closestPoints(pair, at(high)), &after, nullptr);
      const Vector3d a = at(low).col(1) - at(low).col(0), b = at(low).col(3) - at(low).col(2);
      if (pair == SimplexPair::edgeEdge && a.cross(b).norm() < 1e-2) continue;  // the kink that is mollified
      const Vector3d c = at(low).col(2) - at(low).col(1), d = at(low).col(3) - at(low).col(1);
      if (pair == SimplexPair::pointTriangle && c.cross(d).norm() < 1e-2) continue;
      if (c.norm() < 1e-2 && pair == SimplexPair::pointEdge) continue;
      ++changes;
      QVERIFY2((after - before).norm() < 1e-4, qPrintable(QString::number((after - before).norm())));
    }
  QVERIFY(changes > 1000);
}

QTEST_GUILESS_MAIN(TestSimplexDistance)
#include "test_simplex_distance.moc"
