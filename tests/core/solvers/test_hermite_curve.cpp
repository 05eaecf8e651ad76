#include <QTest>

#include "core/solvers/hermite_curve.hpp"

using Eigen::VectorXd;

class TestHermiteCurve : public QObject {
  Q_OBJECT

 private slots:
  void reproducesPolynomials_data();
  void reproducesPolynomials();
};

void TestHermiteCurve::reproducesPolynomials_data() {
  QTest::addColumn<int>("points");
  QTest::newRow("line") << 1;
  QTest::newRow("cubic") << 2;
  QTest::newRow("quintic") << 3;
}

void TestHermiteCurve::reproducesPolynomials() {
  QFETCH(int, points);
  const int degree = 2 * points - 1;
  Eigen::MatrixXd coefficients(2, degree + 1);
  for (int i = 0; i < coefficients.size(); ++i) coefficients.data()[i] = std::sin(1.0 + i);
  const auto value = [&](double s) {
    VectorXd sum = VectorXd::Zero(2);
    for (int k = 0; k <= degree; ++k) sum += std::pow(s, k) * coefficients.col(k);
    return sum;
  };
  const auto derivative = [&](double s) {
    VectorXd sum = VectorXd::Zero(2);
    for (int k = 1; k <= degree; ++k) sum += k * std::pow(s, k - 1) * coefficients.col(k);
    return sum;
  };
  pliant::solvers::HermiteCurve curve;
  for (int i = 0; i < points; ++i) curve.add(0.3 * i * i - 1, value(0.3 * i * i - 1), derivative(0.3 * i * i - 1));
  for (const double s : {-1.7, -1.0, -0.8, 0.1, 1.4}) {
    QVERIFY((curve.value(s) - value(s)).norm() < 1e-12);
    QVERIFY((curve.derivative(s) - derivative(s)).norm() < 1e-12);
  }
}

QTEST_GUILESS_MAIN(TestHermiteCurve)
#include "test_hermite_curve.moc"
