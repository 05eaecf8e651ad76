#include <QTest>
#include <cmath>

#include "core/harmonic/multi_start.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;

namespace {

constexpr double lowest = 0.2, highest = 3;

/// With v = -1 to 1 between the bounds: (v² - 0.25)² + 0.05 v, which has a minimum on either side, the left one lower.
class TwoWells final : public harmonic::DesignObjective {
 public:
  harmonic::ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector&) const override {
    const double slope = 2 / (highest - lowest);
    const double v = slope * (problem.model().parameters[0]->value(problem.model()) - lowest) - 1;
    const double well = v * v - 0.25;
    return {well * well + 0.05 * v, Matrix::Zero(problem.basis().size(), problem.model().coordinateCount()),
            Vector::Constant(1, slope * (4 * v * well + 0.05))};
  }
};

harmonic::MultiStartResult designed(int starts, base::ExecutionContext& context,
                                    const std::vector<harmonic::DesignConstraint>& constraints = {}) {
  auto model = std::make_shared<Model>(*duffing(0.05, 0, 0.1));
  model->pointMasses[0] = {"mass", {0}, 2.9, lowest, highest};
  harmonic::InverseDesignOptions options;
  options.omega = 1.2;
  options.parameters = {0};
  return harmonic::designFromSeveralStarts(
      HarmonicBalanceProblem(model, {3, 32}), TwoWells(), constraints, options, starts, 1, context);
}

/// The lower minimum on either side, by looking everywhere.
double bestOn(double from, double to) {
  double best = 1;
  for (int i = 0; i <= 1'000'000; ++i) {
    const double v = from + (to - from) * i / 1'000'000;
    best = std::min(best, std::pow(v * v - 0.25, 2) + 0.05 * v);
  }
  return best;
}

}  // namespace

class TestMultiStart : public QObject {
  Q_OBJECT

 private slots:
  /// From the design alone the nearer minimum is found; from several the lower one.
  void findsTheLowerOfTwoMinima() {
    base::ExecutionContext context;
    const auto one = designed(1, context);
    QCOMPARE(one.starts.size(), 1u);
    QVERIFY(std::abs(one.found.design.history.back().objective - bestOn(0, 1)) < 1e-6);
    const auto several = designed(4, context);
    QCOMPARE(several.starts.size(), 4u);
    QVERIFY(several.best > 0);
    QVERIFY(std::abs(several.found.design.history.back().objective - bestOn(-1, 0)) < 1e-6);
    QCOMPARE(
        several.starts[static_cast<std::size_t>(several.best)].reached, several.found.design.history.back().objective);
    for (const harmonic::DesignStart& start : several.starts) {
      QVERIFY(start.reached >= several.found.design.history.back().objective);
      QVERIFY(start.reached <= start.objective);
    }
    // The way begins with the model's own design.
    QCOMPARE(several.found.design.history.front().values[0], 2.9);
    for (std::size_t i = 0; i < several.found.design.history.size(); ++i)
      QCOMPARE(several.found.design.history[i].iteration, static_cast<int>(i));
  }

  /// A mass of at most where v is -0.6 keeps designs off both minima: the best is at the bound. From the design itself,
  /// which breaks the constraint, that is found as well; where v is at least -0.2, the best is the higher minimum.
  void keepsToConstraints() {
    base::ExecutionContext context;
    const double slope = 2 / (highest - lowest);
    const auto massOf = [&](double v) { return lowest + (v + 1) / slope; };
    harmonic::DesignConstraint most{"mass", harmonic::makeTotalMass()};
    most.scale = 1;
    most.upper = massOf(-0.6);
    const auto bounded = designed(4, context, {most});
    QVERIFY(bounded.found.design.report.converged());
    QVERIFY(std::abs(bounded.found.design.history.back().values[0] - massOf(-0.6)) < 1e-5);
    QVERIFY(bounded.found.optimality.violation <= 1e-6);
    QCOMPARE(bounded.found.states.size(), bounded.found.design.history.size());
    QCOMPARE(bounded.found.design.history.front().values[0], 2.9);
    QVERIFY(std::abs(bounded.found.states.front()[0].exactValue - 2.9) < 1e-12);
    most.upper = highest;
    most.lower = massOf(-0.2);
    const auto right = designed(4, context, {most});
    QVERIFY(std::abs(right.found.design.history.back().objective - bestOn(0, 1)) < 1e-6);
  }

  /// With a constraint that does not matter, starts end in both minima, and the lower one counts.
  void startsEndInDifferentMinima() {
    base::ExecutionContext context;
    harmonic::DesignConstraint most{"mass", harmonic::makeTotalMass()};
    most.upper = 2.95;
    const auto several = designed(4, context, {most});
    QVERIFY(std::abs(several.found.design.history.back().objective - bestOn(-1, 0)) < 1e-6);
    QVERIFY(std::abs(several.starts.front().reached - bestOn(0, 1)) < 1e-6);
    QVERIFY(several.best > 0);
    QCOMPARE(several.starts.size(), 4u);
    for (const harmonic::DesignStart& start : several.starts) QVERIFY(start.violation <= 1e-6);
  }

  void cancelledItKeepsWhatItHas() {
    base::ExecutionContext context;
    context.requestCancel();
    const auto result = designed(3, context);
    QVERIFY(result.found.design.report.termination == base::TerminationType::cancelled);
  }
};

QTEST_GUILESS_MAIN(TestMultiStart)
#include "test_multi_start.moc"
