#include <Eigen/Geometry>
#include <QTest>

#include "tests/core/geometry/corner_differences.hpp"

using namespace pliant::geometry;
using Eigen::Vector3d;

class TestEdgeMollifier : public QObject {
  Q_OBJECT

 private slots:
  void valueAndDerivatives();
};

void TestEdgeMollifier::valueAndDerivatives() {
  std::mt19937 random(6);
  int inside = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Corners corners = randomCorners(random);
    const double scale = edgeMollifierScale(corners);
    const Vector3d a = corners.col(1) - corners.col(0), b0 = corners.col(3) - corners.col(2);
    QVERIFY(std::abs(scale - 1e-3 * a.squaredNorm() * b0.squaredNorm()) <= 1e-15);
    if (trial % 4) corners.col(3) = corners.col(2) + a + 0.02 * randomCorners(random).col(0);
    const Vector3d b = corners.col(3) - corners.col(2);
    const double ratio = a.cross(b).squaredNorm() / scale;
    const double value = edgeMollifier(corners, scale, nullptr, nullptr);
    QVERIFY(std::abs(value - (ratio < 1 ? (2 - ratio) * ratio : 1)) < 1e-14);
    CornerVector gradient;
    CornerMatrix hessian;
    edgeMollifier(corners, scale, &gradient, &hessian);
    if (ratio > 0.98) {
      if (ratio > 1) QVERIFY(gradient.isZero(0) && hessian.isZero(0));
      continue;
    }
    ++inside;
    const auto slope = [&](const Corners& x) {
      CornerVector result;
      edgeMollifier(x, scale, &result, nullptr);
      return result;
    };
    const CornerVector expected = gradientByDifferences(
        [&](const Corners& x) { return edgeMollifier(x, scale, nullptr, nullptr); }, corners, 1e-6);
    const CornerMatrix expectedHessian = hessianByDifferences(slope, corners, 1e-6);
    QVERIFY((gradient - expected).norm() <= 1e-6 * std::max(1.0, expected.norm()));
    QVERIFY((hessian - expectedHessian).norm() <= 1e-6 * expectedHessian.norm());
  }
  QVERIFY(inside > 50);
}

QTEST_GUILESS_MAIN(TestEdgeMollifier)
#include "test_edge_mollifier.moc"
