#include <QTest>
#include <cmath>
#include <numbers>

#include "core/math/student_t.hpp"

using namespace pliant;

class TestStudentT : public QObject {
  Q_OBJECT

 private slots:
  /// One degree of freedom is Cauchy's distribution, two have a closed form as well.
  void agreesWithClosedForms() {
    for (const double t : {-30.0, -2.0, -0.3, 0.0, 1e-6, 0.7, 1.0, 5.0, 400.0}) {
      const double one = 0.5 + std::atan(t) / std::numbers::pi, two = 0.5 + t / (2 * std::sqrt(2 + t * t));
      QVERIFY(std::abs(math::studentProbability(t, 1) - one) < 1e-14);
      QVERIFY(std::abs(math::studentProbability(t, 2) - two) < 1e-14);
    }
  }

  /// With many degrees of freedom it is the normal distribution, up to (t³ + t) / 4ν (Abramowitz and Stegun 26.7.5).
  void tendsToTheNormalDistribution() {
    const double normal = 1.959963984540054, freedom = 1e5;
    const double expected = normal + (std::pow(normal, 3) + normal) / (4 * freedom);
    QVERIFY(std::abs(math::studentQuantile(0.975, freedom) - expected) < 1e-8);
  }

  /// Printed tables (Abramowitz and Stegun 26.10).
  void agreesWithTables() {
    QVERIFY(std::abs(math::studentQuantile(0.975, 5) - 2.571) < 5e-4);
    QVERIFY(std::abs(math::studentQuantile(0.975, 30) - 2.042) < 5e-4);
    QVERIFY(std::abs(math::studentQuantile(0.95, 10) - 1.812) < 5e-4);
    QVERIFY(std::abs(math::studentQuantile(0.995, 1) - 63.657) < 5e-4);
  }

  void quantilesInvertProbabilities() {
    for (const double freedom : {1.0, 3.0, 7.5, 60.0, 4000.0})
      for (const double probability : {1e-6, 0.02, 0.3, 0.5, 0.8, 0.999})
        QVERIFY(std::abs(math::studentProbability(math::studentQuantile(probability, freedom), freedom) - probability) <
                1e-12);
  }

  /// I_x(a, b) of whole a and b is a sum of binomial probabilities.
  void incompleteBetaIsABinomialSum() {
    const double x = 0.37;
    double sum = 0;
    for (int k = 3; k <= 7; ++k)
      sum += std::tgamma(8) / (std::tgamma(k + 1) * std::tgamma(8 - k)) * std::pow(x, k) * std::pow(1 - x, 7 - k);
    QVERIFY(std::abs(math::incompleteBeta(3, 5, x) - sum) < 1e-13);
  }
};

QTEST_GUILESS_MAIN(TestStudentT)
#include "test_student_t.moc"
