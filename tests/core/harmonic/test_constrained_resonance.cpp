#include <QTest>

#include "core/harmonic/constrained_design.hpp"
#include "core/harmonic/resonance_objective.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;

/// Resonances that are placed under constraints: m x'' + α m x' + x = F cos ωt.
class TestConstrainedResonance : public QObject {
  Q_OBJECT

  static constexpr double alpha = 0.1;

 private slots:
  void placesResonances_data();
  void placesResonances();
  void saysThatThereIsNoPeak();
};

void TestConstrainedResonance::placesResonances_data() {
  QTest::addColumn<bool>("linear");
  QTest::addColumn<double>("wanted");
  QTest::addColumn<double>("least");
  QTest::addColumn<double>("most");
  QTest::addColumn<double>("expected");  // mass
  for (const bool linear : {true, false}) {
    const char* kind = linear ? "natural frequency" : "peak";
    QTest::addRow("%s within reach", kind) << linear << 1.0 << 0.5 << 1.5 << 0.0;
    QTest::addRow("%s below", kind) << linear << 0.6 << 0.5 << 1.5 << 1.5;
    QTest::addRow("%s above", kind) << linear << 1.3 << 0.8 << 1.5 << 0.8;
  }
}

/// √(k / m), or √(1 / m - α² / 2) of the peak, at a frequency or as near as a total mass allows.
void TestConstrainedResonance::placesResonances() {
  QFETCH(bool, linear);
  QFETCH(double, wanted);
  QFETCH(double, least);
  QFETCH(double, most);
  QFETCH(double, expected);
  harmonic::InverseDesignOptions options;
  options.omega = 2.5;  // away from the resonances
  options.parameters = {0};
  options.motion.tolerance = 1e-12;
  options.optimizer.gradientTolerance = 1e-7;
  harmonic::ResonancePlacement peak;
  peak.frequency = wanted;
  peak.from = 0.4;
  peak.to = 2;
  const auto objective =
      linear ? harmonic::makeLinearResonancePlacement({wanted, 0}) : harmonic::makeResonancePlacement(peak);
  harmonic::DesignConstraint mass{"mass", harmonic::makeTotalMass()};
  mass.lower = least;
  mass.upper = most;
  base::ExecutionContext context;
  auto model = std::make_shared<Model>(*duffing(alpha / 2, 0, 0.1));
  model->pointMasses[0] = {"mass", {0}, 1.1, 0.2, 3};
  const harmonic::ConstrainedDesignResult result = harmonic::designWithConstraints(
      harmonic::HarmonicBalanceProblem(model, {3, 32}), *objective, {mass}, options, context);
  QVERIFY2(result.design.report.converged(), result.design.report.message.c_str());
  if (expected == 0) expected = 1 / (wanted * wanted + (linear ? 0 : alpha * alpha / 2));
  const double found = result.design.history.back().values[0];
  QVERIFY2(std::abs(found - expected) < 1e-3, qPrintable(QString::number(found)));
  QVERIFY(result.optimality.violation <= 1e-6);
}

/// The first design has no peak in the range, and so no objective.
void TestConstrainedResonance::saysThatThereIsNoPeak() {
  harmonic::InverseDesignOptions options;
  options.omega = 2.5;
  options.parameters = {0};
  harmonic::ResonancePlacement peak;
  peak.frequency = 3;
  peak.from = 2;
  peak.to = 4;
  harmonic::DesignConstraint mass{"mass", harmonic::makeTotalMass()};
  mass.upper = 2;
  base::ExecutionContext context;
  const auto result =
      harmonic::designWithConstraints(harmonic::HarmonicBalanceProblem(duffing(alpha / 2, 0, 0.1), {3, 32}),
                                      *harmonic::makeResonancePlacement(peak), {mass}, options, context);
  QVERIFY(!result.design.report.converged());
  QVERIFY(!result.design.report.message.empty());
}

QTEST_GUILESS_MAIN(TestConstrainedResonance)
#include "test_constrained_resonance.moc"
