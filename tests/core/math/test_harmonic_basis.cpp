#include <QTest>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "core/math/harmonic_basis.hpp"

using pliant::math::HarmonicBasis;

namespace {

/// Coefficients of a cubic force of the motion x(τ), projected with `samples` samples.
Eigen::VectorXd cubicForce(int harmonics, int samples, const Eigen::VectorXd& motion) {
  const HarmonicBasis basis(harmonics, samples);
  return basis.analysis() * (basis.synthesis() * motion).array().cube().matrix();
}

}  // namespace

class HarmonicBasisTest : public QObject {
  Q_OBJECT

 private:
  std::mt19937 generator_{7};

  Eigen::VectorXd randomVector(Eigen::Index size) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    return Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(generator_); });
  }

 private slots:
  void refusesTooFewSamples() {
    QVERIFY_THROWS_EXCEPTION(std::invalid_argument, HarmonicBasis(-1, 5));
    QVERIFY_THROWS_EXCEPTION(std::invalid_argument, HarmonicBasis(3, 6));
    QCOMPARE(HarmonicBasis(3, 7).size(), 7);
    QCOMPARE(HarmonicBasis(0, 1).size(), 1);
  }

  void refusesImpossibleRatios() {
    for (const double ratio : {0.0, -1.5, std::nan(""), std::numeric_limits<double>::infinity()})
      QVERIFY_THROWS_EXCEPTION(std::invalid_argument, HarmonicBasis::ofTwoFrequencies(3, 7, ratio));
    QVERIFY_THROWS_EXCEPTION(std::invalid_argument, HarmonicBasis::ofTwoFrequencies(3, 6, 1.5));
    QVERIFY_THROWS_EXCEPTION(std::invalid_argument, HarmonicBasis::ofTwoFrequencies(3, 7, 1.5, -1));
  }

  void twoFrequencies_data() {
    QTest::addColumn<int>("order");
    QTest::addColumn<int>("samples");
    QTest::newRow("constant") << 0 << 1;
    QTest::newRow("fewest samples") << 4 << 9;
    QTest::newRow("even samples") << 3 << 16;
  }
  void twoFrequencies() {
    QFETCH(int, order);
    QFETCH(int, samples);
    const double ratio = std::numbers::sqrt2;
    const HarmonicBasis basis = HarmonicBasis::ofTwoFrequencies(order, samples, ratio, 5);
    QCOMPARE(basis.harmonics(), order * (order + 1));
    QCOMPARE(basis.samples(), samples * samples);
    const Eigen::MatrixXd product = basis.analysis() * basis.synthesis();
    QVERIFY((product - Eigen::MatrixXd::Identity(basis.size(), basis.size())).cwiseAbs().maxCoeff() < 1e-13);
    for (const int i : {0, samples / 2, samples * samples / 2, samples * samples - 1})
      QVERIFY((basis.synthesis().row(i).transpose() - basis.valuesAtPhases(basis.samplePhases(i))).norm() < 1e-12);
    const Eigen::VectorXd c = randomVector(basis.size());
    const Eigen::VectorXd rate = basis.derivative(c);
    const double step = 1e-5;
    for (const double tau : {0.0, 0.7, 5.1}) {
      const auto at = [&](double t) { return basis.valuesAtPhases({5 * t, 5 * ratio * t}).dot(c); };
      QVERIFY(std::abs(at(tau) - basis.valuesAt(tau).dot(c)) < 1e-12);
      QVERIFY(std::abs((at(tau + step) - at(tau - step)) / (2 * step) - basis.valuesAt(tau).dot(rate)) < 1e-5);
    }
    const Eigen::VectorXd second = basis.secondDerivative(c);
    QVERIFY((basis.derivative(rate) - second).norm() <= 1e-13 * second.norm());
    // Coefficients of a lower order come first.
    for (int lower = 0; lower < order; ++lower) {
      const auto all = basis.combinations(order), some = basis.combinations(lower);
      QVERIFY(std::equal(some.begin(), some.end(), all.begin()));
    }
  }
  /// After so many periods both phases are nearly at the start again: 29 √2 = 41.01.
  void returnsClose() {
    QCOMPARE(HarmonicBasis::ofTwoFrequencies(1, 3, std::numbers::sqrt2).periods(), 29);
    QCOMPARE(HarmonicBasis::ofTwoFrequencies(1, 3, 1.5).periods(), 2);
    QCOMPARE(HarmonicBasis::ofTwoFrequencies(1, 3, 0.001).periods(), 32);
    QCOMPARE(HarmonicBasis(3, 7).periods(), 1);
  }

  void analysisInvertsSynthesis_data() {
    QTest::addColumn<int>("harmonics");
    QTest::addColumn<int>("samples");
    QTest::newRow("constant") << 0 << 1;
    QTest::newRow("fewest samples") << 5 << 11;
    QTest::newRow("even samples") << 5 << 12;
    QTest::newRow("thesis") << 5 << 64;
    QTest::newRow("many harmonics") << 40 << 161;
  }
  void analysisInvertsSynthesis() {
    QFETCH(int, harmonics);
    QFETCH(int, samples);
    const HarmonicBasis basis(harmonics, samples);
    const Eigen::MatrixXd product = basis.analysis() * basis.synthesis();
    const double error = (product - Eigen::MatrixXd::Identity(basis.size(), basis.size())).cwiseAbs().maxCoeff();
    QVERIFY2(error < 1e-13, qPrintable(QString::number(error)));
  }

  void synthesisEvaluatesTheSeries() {
    const HarmonicBasis basis(6, 40);
    const Eigen::VectorXd c = randomVector(basis.size());
    const Eigen::VectorXd samples = basis.synthesis() * c;
    for (int i = 0; i < basis.samples(); ++i) {
      const double tau = 2 * std::numbers::pi * i / basis.samples();
      double expected = c[0];
      for (int k = 1; k <= 6; ++k) expected += c[2 * k - 1] * std::sin(k * tau) + c[2 * k] * std::cos(k * tau);
      QVERIFY(std::abs(samples[i] - expected) < 1e-13);
      QVERIFY(std::abs(basis.valuesAt(tau).dot(c) - expected) < 1e-13);
    }
  }

  void analysisIsTheFourierIntegral() {
    // exp(cos τ) has the coefficients I_0(1) and 2 I_k(1) (Abramowitz & Stegun 9.6.34).
    const HarmonicBasis basis(8, 48);
    Eigen::VectorXd samples(48);
    for (int i = 0; i < 48; ++i) samples[i] = std::exp(std::cos(2 * std::numbers::pi * i / 48));
    const Eigen::VectorXd c = basis.analysis() * samples;
    for (int k = 0; k <= 8; ++k) {
      const double expected = (k == 0 ? 1 : 2) * std::cyl_bessel_i(k, 1.0);
      QVERIFY(std::abs(c[2 * k] - expected) < 1e-14);
      if (k > 0) QVERIFY(std::abs(c[2 * k - 1]) < 1e-14);
    }
  }

  void derivativesAreThoseOfTheSeries() {
    const HarmonicBasis basis(5, 11);
    Eigen::MatrixXd c(basis.size(), 2);
    c << randomVector(basis.size()), randomVector(basis.size());
    const Eigen::MatrixXd first = basis.derivative(c);
    const Eigen::MatrixXd second = basis.secondDerivative(c);
    for (const double tau : {0.0, 0.3, 1.7, 4.0}) {
      for (int column = 0; column < 2; ++column) {
        double velocity = 0;
        double acceleration = 0;
        for (int k = 1; k <= 5; ++k) {
          const double s = c(2 * k - 1, column);
          const double co = c(2 * k, column);
          velocity += k * (s * std::cos(k * tau) - co * std::sin(k * tau));
          acceleration -= k * k * (s * std::sin(k * tau) + co * std::cos(k * tau));
        }
        QVERIFY(std::abs(basis.valuesAt(tau).dot(first.col(column)) - velocity) < 1e-12);
        QVERIFY(std::abs(basis.valuesAt(tau).dot(second.col(column)) - acceleration) < 1e-12);
      }
    }
  }

  void cubicForcesAreExactFromFourHPlusOneSamples() {
    const int harmonics = 4;
    const Eigen::VectorXd motion = randomVector(2 * harmonics + 1);
    const Eigen::VectorXd exact = cubicForce(harmonics, 200, motion);
    const double scale = exact.cwiseAbs().maxCoeff();
    const Eigen::VectorXd enough = cubicForce(harmonics, 4 * harmonics + 1, motion);
    QVERIFY((enough - exact).cwiseAbs().maxCoeff() < 1e-13 * scale);
    for (const int samples : {2 * harmonics + 1, 4 * harmonics}) {
      const double error = (cubicForce(harmonics, samples, motion) - exact).cwiseAbs().maxCoeff();
      QVERIFY2(error > 1e-3 * scale, "fewer samples fold the third harmonics back");
    }
  }
};

QTEST_GUILESS_MAIN(HarmonicBasisTest)
#include "test_harmonic_basis.moc"
