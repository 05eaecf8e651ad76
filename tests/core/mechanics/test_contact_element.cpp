#include <Eigen/Dense>
#include <QTest>
#include <cmath>
#include <map>
#include <random>

#include "core/mechanics/contact_element.hpp"

using namespace pliant::mechanics;
using namespace pliant::geometry;
using Eigen::Vector3d;

namespace {

constexpr double range = 0.3, offset = 0.1, stiffness = 7;
constexpr std::array allPairs = {
    SimplexPair::pointPoint, SimplexPair::pointEdge, SimplexPair::pointTriangle, SimplexPair::edgeEdge};

ContactElement elementOf(SimplexPair pair, const Corners& corners, double scale) {
  ContactElement element{corners, closestPoints(pair, corners), 0, stiffness, range, scale};
  element.gap = std::sqrt(element.closest.squaredDistance) - offset;
  return element;
}

int regionOf(const ClosestPoints& closest) {
  int region = 0;
  for (int i = 0; i < 4; ++i)
    if (closest.weights[i] != 0) region |= 1 << i;
  return region;
}

CornerMatrix positivePart(const CornerMatrix& matrix) {
  const Eigen::SelfAdjointEigenSolver<CornerMatrix> solver(0.5 * (matrix + matrix.transpose()));
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() * solver.eigenvectors().transpose();
}

/// Checks gradient and Hessian of one element by central differences; false if a region changes within the differences.
bool verifyDerivatives(SimplexPair pair, const Corners& corners, double scale) {
  constexpr double step = 1e-6;
  const ContactElement element = elementOf(pair, corners, scale);
  CornerVector gradient;
  CornerMatrix hessian;
  for (int i = 0; i < 12; ++i) {
    std::array<ContactElement, 2> moved;
    for (const int side : {0, 1}) {
      Corners x = corners;
      x.reshaped()[i] += side == 0 ? -step : step;
      moved[side] = elementOf(pair, x, scale);
      if (regionOf(moved[side].closest) != regionOf(element.closest)) return false;
    }
    gradient[i] = (moved[1].value() - moved[0].value()) / (2 * step);
    hessian.col(i) = (moved[1].gradient() - moved[0].gradient()) / (2 * step);
  }
  // Third derivatives grow with the barrier's; relative to the second they are below 1/gap² or so.
  const double tolerance = 1e-6;
  const double gradientError = (element.gradient() - gradient).norm();
  [&] {
    QVERIFY2(gradientError <= tolerance * std::max(1.0, gradient.norm()), qPrintable(QString::number(gradientError)));
    for (const double convexity : {0.0, 0.25, 1.0}) {
      const CornerMatrix expected = (1 - convexity) * hessian + convexity * positivePart(hessian);
      const double error = (element.hessian(convexity) - expected).norm();
      QVERIFY2(error <= 10 * tolerance * std::max(1.0, hessian.norm()),
               qPrintable(QString("%1 of %2 with %3").arg(error).arg(hessian.norm()).arg(convexity)));
    }
    Vector3d force = Vector3d::Zero();
    for (int i = 0; i < firstCornerCount(pair); ++i) force -= gradient.segment<3>(3 * i);
    QVERIFY((element.force() - force).norm() <= tolerance * std::max(1.0, gradient.norm()));
  }();
  return true;
}

}  // namespace

class TestContactElement : public QObject {
  Q_OBJECT

 private slots:
  void barrierIsThatOfItsFormula();
  void derivativesInEveryRegion();
  void derivativesOfNearlyParallelEdges();
  void energyIsTheWorkAlongPathsThroughAllRegions_data();
  void energyIsTheWorkAlongPathsThroughAllRegions();
};

void TestContactElement::barrierIsThatOfItsFormula() {
  const auto b = [](double gap) { return -std::pow(gap - range, 2) * std::log(gap / range); };
  for (const double gap : {1e-3, 0.05, 0.1, 0.2, 0.29}) {
    const BarrierFunction barrier(gap, range);
    const double step = 1e-4 * std::min(gap, range - gap);
    QVERIFY(std::abs(barrier.value - b(gap)) <= 1e-14 * b(gap));
    QVERIFY(std::abs(barrier.slope - (b(gap + step) - b(gap - step)) / (2 * step)) <= 1e-6 * std::abs(barrier.slope));
    const double slopes = BarrierFunction(gap + step, range).slope - BarrierFunction(gap - step, range).slope;
    QVERIFY(std::abs(barrier.curvature - slopes / (2 * step)) <= 1e-6 * barrier.curvature);
  }
  for (const double gap : {range, 1.0, 1e300}) {
    const BarrierFunction barrier(gap, range);
    QVERIFY(barrier.value == 0 && barrier.slope == 0 && barrier.curvature == 0);
  }
  QVERIFY(BarrierFunction(1e-12, range).value > BarrierFunction(1e-9, range).value);
}

void TestContactElement::derivativesInEveryRegion() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-0.5, 0.5);
  const std::array<std::size_t, 4> expected = {1, 3, 7, 9};
  for (const SimplexPair pair : allPairs) {
    std::map<int, int> regions;
    for (int trial = 0; trial < 40000; ++trial) {
      const Corners corners = Corners::NullaryExpr([&] { return coordinate(random); });
      const Vector3d a = corners.col(1) - corners.col(0), b = corners.col(2) - corners.col(1),
                     c = corners.col(3) - corners.col(2);
      // Edges and triangles that differences can resolve; a gap well inside the range.
      if (a.norm() < 0.2 && pair == SimplexPair::edgeEdge) continue;
      if (b.norm() < 0.2 || c.norm() < 0.2 || b.cross(c).norm() < 0.05) continue;
      if (pair == SimplexPair::edgeEdge && a.cross(c).norm() < 0.05) continue;
      const ContactElement element = elementOf(pair, corners, 0);
      if (element.gap < 0.03 || element.gap > 0.95 * range) continue;
      const double scale = pair == SimplexPair::edgeEdge ? edgeMollifierScale(corners) : 0;
      if (verifyDerivatives(pair, corners, scale)) ++regions[regionOf(element.closest)];
      if (QTest::currentTestFailed()) return;
    }
    QCOMPARE(regions.size(), expected[static_cast<int>(pair)]);
    for (const auto& [region, count] : regions) QVERIFY(count >= 5);
  }
}

void TestContactElement::derivativesOfNearlyParallelEdges() {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::map<int, int> regions;
  for (int trial = 0; trial < 3000; ++trial) {
    const auto vector = [&] { return Vector3d(coordinate(random), coordinate(random), coordinate(random)); };
    const Vector3d edge = vector().normalized(), place = vector();
    Corners corners;
    corners.col(0) = place;
    corners.col(1) = place + edge;
    corners.col(2) = place + 2.2 * coordinate(random) * edge + 0.25 * vector();
    corners.col(3) = corners.col(2) + (trial % 2 ? 1 : -1) * edge + 0.02 * vector();
    const double scale = edgeMollifierScale(corners);
    const double squaredSine = edge.cross(corners.col(3) - corners.col(2)).squaredNorm();
    // Nearer to parallel, regions are as narrow as the steps of the differences.
    if (squaredSine < 5e-5 || squaredSine > 0.9 * scale) continue;
    const ContactElement element = elementOf(SimplexPair::edgeEdge, corners, scale);
    if (element.gap < 0.03 || element.gap > 0.95 * range) continue;
    if (verifyDerivatives(SimplexPair::edgeEdge, corners, scale)) ++regions[regionOf(element.closest)];
    if (QTest::currentTestFailed()) return;
  }
  QVERIFY(regions.size() == 9);
  QVERIFY(regions[15] > 5);
}

void TestContactElement::energyIsTheWorkAlongPathsThroughAllRegions_data() {
  QTest::addColumn<int>("pair");
  QTest::addColumn<Corners>("from");
  QTest::addColumn<Corners>("to");
  Corners from, to;
  from << -1, 0, 1, 0, 0.2, 0, 0, 1, 0.25, 0, 0, 0;
  to = from;
  to.col(0) << 1.2, 0.4, 0.2;
  QTest::newRow("point over a triangle") << static_cast<int>(SimplexPair::pointTriangle) << from << to;
  // Parallel in the middle of the path, where the distance of the second example has a kink without the mollifier.
  from << -0.5, 0.5, -0.4, 0.6, 0, 0, -0.1, 0.1, 0, 0, 0.2, 0.2;
  to << -0.5, 0.5, -0.4, 0.6, 0, 0, 0.1, -0.1, 0, 0, 0.2, 0.2;
  QTest::newRow("edge turns over an edge") << static_cast<int>(SimplexPair::edgeEdge) << from << to;
  from << -0.5, 0.5, -0.4, 0.6, 0, 0, 0, 0, 0, 0, 0.15, 0.25;
  to << -0.5, 0.5, -0.4, 0.6, 0, 0, 0, 0, 0, 0, 0.25, 0.15;
  QTest::newRow("edge tilts over an edge") << static_cast<int>(SimplexPair::edgeEdge) << from << to;
}

void TestContactElement::energyIsTheWorkAlongPathsThroughAllRegions() {
  QFETCH(int, pair);
  QFETCH(Corners, from);
  QFETCH(Corners, to);
  const auto kind = static_cast<SimplexPair>(pair);
  const double scale = kind == SimplexPair::edgeEdge ? edgeMollifierScale(from) : 0;
  const auto at = [&](double t) { return elementOf(kind, from + t * (to - from), scale); };
  const CornerVector direction = (to - from).reshaped();
  // The trapezoidal sums of the power converge with the square of the step where the gradient is continuous.
  std::map<int, int> regions;
  double largest = 0, errorBefore = 0;
  for (const int n : {1000, 10000}) {
    double work = 0, error = 0, power = at(0).gradient().dot(direction);
    for (int i = 1; i <= n; ++i) {
      const ContactElement element = at(double(i) / n);
      const double next = element.gradient().dot(direction);
      work += 0.5 * (power + next) / n;
      power = next;
      largest = std::max(largest, element.value());
      error = std::max(error, std::abs(element.value() - at(0).value() - work));
      ++regions[regionOf(element.closest)];
    }
    if (errorBefore > 0) QVERIFY2(error <= errorBefore / 50, qPrintable(QString::number(errorBefore / error)));
    errorBefore = error;
  }
  QVERIFY(errorBefore <= 1e-5 * largest);
  QVERIFY(kind == SimplexPair::edgeEdge || regions.size() >= 3);
}

QTEST_GUILESS_MAIN(TestContactElement)
#include "test_contact_element.moc"
