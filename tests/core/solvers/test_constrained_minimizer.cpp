#include <QTest>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "core/solvers/constrained_minimizer.hpp"

using namespace pliant;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using solvers::ConstrainedBounds;
using solvers::ConstrainedSolution;
using solvers::ConstrainedValue;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class Function final : public solvers::ConstrainedFunction {
 public:
  using Formula = std::function<std::optional<ConstrainedValue>(const VectorXd&)>;
  explicit Function(Formula formula) : formula_(std::move(formula)) {}
  std::optional<ConstrainedValue> evaluate(const VectorXd& x, bool withDerivatives) override {
    auto value = formula_(x);
    if (value && !withDerivatives) {
      value->gradient.resize(0);
      value->jacobian.resize(0, 0);
    }
    return value;
  }

 private:
  Formula formula_;
};

/// Rosenbrock's valley with g = x² + y².
std::optional<ConstrainedValue> valley(const VectorXd& x) {
  const double a = x[1] - x[0] * x[0], b = 1 - x[0];
  return ConstrainedValue{100 * a * a + b * b, VectorXd::Constant(1, x.squaredNorm()),
                          Vector2d(-400 * a * x[0] - 2 * b, 200 * a), 2 * x.transpose()};
}

ConstrainedBounds bounds(double lower, double upper) {
  return {
      VectorXd::Constant(2, -2), VectorXd::Constant(2, 2), VectorXd::Constant(1, lower), VectorXd::Constant(1, upper)};
}

ConstrainedSolution minimize(const Function::Formula& formula, const VectorXd& start, const ConstrainedBounds& within) {
  base::ExecutionContext context;
  Function function(formula);
  return solvers::minimizeWithConstraints(function, start, within, {}, context);
}

/// The best point on the circle of radius r, by a search along it.
double leastOnCircle(double radius) {
  double least = infinity;
  for (int i = 0; i < 2'000'000; ++i) {
    const double angle = 2 * M_PI * i / 2e6;
    least = std::min(least, valley(radius * Vector2d(std::cos(angle), std::sin(angle)))->objective);
  }
  return least;
}

}  // namespace

class TestConstrainedMinimizer : public QObject {
  Q_OBJECT

 private slots:
  /// The minimum at (1, 1) is out of reach within a circle of radius 1.
  void findsTheBestOfADisk() {
    const ConstrainedSolution solution = minimize(valley, Vector2d(-0.5, 0.5), bounds(-infinity, 1));
    QVERIFY2(solution.report.converged(), solution.report.message.c_str());
    QVERIFY(std::abs(solution.value.objective - leastOnCircle(1)) < 1e-6);
    QVERIFY(solution.optimality.stationarity < 1e-5 && solution.optimality.violation <= 1e-6);
    // ∇f = -λ ∇g.
    const auto at = valley(solution.x);
    QVERIFY(std::abs(solution.optimality.multipliers[0] * 2 * solution.x[0] + at->gradient[0]) < 1e-5);
    QVERIFY(solution.optimality.multipliers[0] > 0);
  }

  void findsTheBestOfARing() {
    const ConstrainedSolution solution = minimize(valley, Vector2d(1.2, 1), bounds(3, 3));
    QVERIFY2(solution.report.converged(), solution.report.message.c_str());
    QVERIFY(std::abs(solution.x.squaredNorm() - 3) < 1e-6);
    QVERIFY(std::abs(solution.value.objective - leastOnCircle(std::sqrt(3))) < 1e-6);
    QVERIFY(solution.optimality.stationarity < 1e-5);
    QVERIFY(solution.optimality.multipliers[0] < 0);  // a smaller circle would be better
  }

  /// Points that are not optimal are seen to be so, whatever the optimiser says.
  void knowsWhatIsNotOptimal() {
    const VectorXd x = Vector2d(0.6, 0.8);
    const auto optimality = solvers::optimalityOf(*valley(x), x, bounds(-infinity, 1));
    QVERIFY(optimality.stationarity > 0.1);
    QVERIFY(optimality.violation < 1e-12);
    const VectorXd outside = Vector2d(1.2, 0);
    QVERIFY(std::abs(solvers::optimalityOf(*valley(outside), outside, bounds(-infinity, 1)).violation - 0.44) < 1e-12);
  }

  void stepsBackFromWhereThereIsNothing() {
    int failures = 0;
    const auto walled = [&](const VectorXd& x) -> std::optional<ConstrainedValue> {
      if (x[0] > 0.8 || x[1] < -0.2) return ++failures, std::nullopt;
      return valley(x);
    };
    const ConstrainedSolution solution = minimize(walled, Vector2d(-1.2, 1), bounds(-infinity, 0.8));
    QVERIFY2(solution.report.converged(), solution.report.message.c_str());
    QVERIFY(std::abs(solution.value.objective - leastOnCircle(std::sqrt(0.8))) < 1e-6);
    QVERIFY(failures > 0);
  }

  void saysThatNothingIsFeasible() {
    const ConstrainedSolution solution = minimize(valley, Vector2d(-0.5, 0.5), bounds(9, infinity));
    QVERIFY(!solution.report.converged());
    QVERIFY(!solution.report.message.empty());
    QVERIFY(solution.optimality.violation > 0.5);
  }

  void keepsTheBestFeasiblePointWhenCancelled() {
    base::ExecutionContext context;
    Function function(valley);
    double best = infinity;
    const ConstrainedSolution solution = solvers::minimizeWithConstraints(
        function, Vector2d(-0.5, 0.5), bounds(-infinity, 1), {}, context, [&](const solvers::ConstrainedIterate& at) {
          if (at.violation <= 1e-6) best = std::min(best, at.value.objective);
          if (at.iteration == 5) context.requestCancel();
        });
    QVERIFY(solution.report.termination == base::TerminationType::cancelled);
    QVERIFY(solution.value.objective <= best && solution.optimality.violation <= 1e-6);
  }

  void passesExceptionsOn() {
    int calls = 0;
    const auto throwing = [&](const VectorXd& x) -> std::optional<ConstrainedValue> {
      if (++calls > 5) throw std::runtime_error("no model");
      return valley(x);
    };
    QVERIFY_THROWS_EXCEPTION(std::runtime_error, minimize(throwing, Vector2d(-0.5, 0.5), bounds(-infinity, 1)));
  }
};

QTEST_GUILESS_MAIN(TestConstrainedMinimizer)
#include "test_constrained_minimizer.moc"
