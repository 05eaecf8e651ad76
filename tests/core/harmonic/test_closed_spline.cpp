#include "core/harmonic/closed_spline.hpp"

#include <QTest>
#include <cmath>
#include <numbers>

using namespace pliant;
using Eigen::MatrixXd;
using std::numbers::pi;

namespace {

/// An oval that is not an ellipse, at `count` even times.
MatrixXd oval(int count) {
  MatrixXd points(2, count);
  for (int i = 0; i < count; ++i) {
    const double tau = 2 * pi * i / count;
    points.col(i) << std::cos(tau) + 0.2 * std::sin(2 * tau), 0.7 * std::sin(tau);
  }
  return points;
}

}  // namespace

class TestClosedSpline : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void passesItsPoints() {
    const MatrixXd points = MatrixXd::Random(3, 7), curve = harmonic::closedSpline(points, 5);
    QCOMPARE(curve.cols(), Eigen::Index(35));
    for (Eigen::Index i = 0; i < 7; ++i) QVERIFY((curve.col(5 * i) - points.col(i)).norm() <= 1e-14);
  }

  /// Of order 4 in the steps of time between points.
  void convergesToASmoothCurve() {
    const auto error = [](int count) {
      return (harmonic::closedSpline(oval(count), 16) - oval(16 * count)).colwise().norm().maxCoeff();
    };
    const double order = std::log2(error(24) / error(48));
    QVERIFY2(std::abs(order - 4) < 0.2, qPrintable(QString::number(order)));
  }

  /// First and second derivatives by time are the same on both sides of every point, that where it closes too.
  void isSmoothAtItsPoints() {
    constexpr int pieces = 6, steps = 2000;
    const MatrixXd curve = harmonic::closedSpline(MatrixXd::Random(2, pieces), steps);
    const auto at = [&](int i) { return curve.col((i + curve.cols()) % curve.cols()); };
    const auto second = [&](int i) { return (steps * double(steps) * (at(i + 1) - 2 * at(i) + at(i - 1))).eval(); };
    for (int i = 0; i < pieces; ++i) {
      const int knot = i * steps;
      // Third derivatives jump, so differences astride the point and beside it agree to first order of the step.
      QVERIFY((steps * (at(knot + 1) - at(knot)) - steps * (at(knot) - at(knot - 1))).norm() <= 60.0 / steps);
      QVERIFY((second(knot + 1) - second(knot - 1)).norm() <= 300.0 / steps);
    }
  }

  /// Begun elsewhere it is the same curve.
  void hasNoBeginning() {
    const MatrixXd points = MatrixXd::Random(2, 5);
    MatrixXd turned(2, 5);
    turned << points.rightCols(3), points.leftCols(2);
    const MatrixXd a = harmonic::closedSpline(points, 8), b = harmonic::closedSpline(turned, 8);
    QVERIFY((a.rightCols(24) - b.leftCols(24)).norm() <= 1e-13);
    QVERIFY((a.leftCols(16) - b.rightCols(16)).norm() <= 1e-13);
  }
};

QTEST_GUILESS_MAIN(TestClosedSpline)
#include "test_closed_spline.moc"
