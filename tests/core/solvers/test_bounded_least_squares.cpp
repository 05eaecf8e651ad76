#include <Eigen/Dense>
#include <QTest>
#include <cmath>
#include <functional>
#include <random>

#include "core/solvers/bounded_least_squares.hpp"
#include "core/solvers/parameter_uncertainty.hpp"

using namespace pliant;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using solvers::BoundedLeastSquaresOptions;

namespace {

class Residuals final : public solvers::ResidualFunction {
 public:
  using Formula = std::function<bool(const VectorXd&, VectorXd&, MatrixXd*)>;
  explicit Residuals(Formula formula) : formula_(std::move(formula)) {}
  bool evaluate(const VectorXd& x, VectorXd& residuals, MatrixXd* jacobian) override {
    return formula_(x, residuals, jacobian);
  }

 private:
  Formula formula_;
};

/// Rosenbrock's valley as residuals: (10 (y - x²), 1 - x).
bool rosenbrock(const VectorXd& x, VectorXd& r, MatrixXd* jacobian) {
  r = Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]);
  if (jacobian) *jacobian = (MatrixXd(2, 2) << -20 * x[0], 10, -1, 0).finished();
  return true;
}

base::SolverReport fit(const Residuals::Formula& formula, VectorXd& x, const VectorXd& lower, const VectorXd& upper,
                       const BoundedLeastSquaresOptions& options = {}) {
  base::ExecutionContext context;
  Residuals residuals(formula);
  return solvers::fitWithinBounds(residuals, x, lower, upper, options, context);
}

MatrixXd randomMatrix(Index rows, Index columns, std::mt19937& random) {
  std::normal_distribution<double> entry;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return entry(random); });
}

}  // namespace

class TestBoundedLeastSquares : public QObject {
  Q_OBJECT

 private slots:
  void findsTheEndOfAValley() {
    VectorXd x = Eigen::Vector2d(-1.2, 1);
    const auto report = fit(rosenbrock, x, VectorXd::Constant(2, -10), VectorXd::Constant(2, 10));
    QVERIFY2(report.converged(), report.message.c_str());
    QVERIFY((x - Eigen::Vector2d(1, 1)).norm() < 1e-9);
  }

  /// With x <= 0.5 the minimum is at x = 0.5, y = 0.25.
  void stopsAtABound() {
    VectorXd x = Eigen::Vector2d(-1.2, 1);
    const auto report = fit(rosenbrock, x, VectorXd::Constant(2, -10), Eigen::Vector2d(0.5, 10));
    QVERIFY2(report.converged(), report.message.c_str());
    QCOMPARE(x[0], 0.5);
    QVERIFY(std::abs(x[1] - 0.25) < 1e-7);
  }

  /// Where there are no residuals beyond x = 0.4, steps are shortened, and the end of what is possible is not called a
  /// minimum.
  void stepsBackFromWhereThereIsNothing() {
    VectorXd x = Eigen::Vector2d(-1.2, 1);
    const auto walled = [](const VectorXd& at, VectorXd& r, MatrixXd* jacobian) {
      return at[0] <= 0.4 && rosenbrock(at, r, jacobian);
    };
    const auto report = fit(walled, x, VectorXd::Constant(2, -10), VectorXd::Constant(2, 10));
    QVERIFY(!report.converged());
    QVERIFY(!report.message.empty());
    QVERIFY(x[0] > 0.3 && x[0] <= 0.4);
  }

  void keepsTheBestWhenCancelled() {
    VectorXd x = Eigen::Vector2d(-1.2, 1);
    base::ExecutionContext context;
    Residuals residuals(rosenbrock);
    double last = 0;
    const auto report = solvers::fitWithinBounds(residuals, x, VectorXd::Constant(2, -10), VectorXd::Constant(2, 10),
                                                 {}, context, [&](const solvers::LeastSquaresIterate& iterate) {
                                                   last = iterate.residuals.norm();
                                                   if (iterate.iteration == 3) context.requestCancel();
                                                 });
    QVERIFY(report.termination == base::TerminationType::cancelled);
    VectorXd r;
    rosenbrock(x, r, nullptr);
    QCOMPARE(r.norm(), last);
  }

  /// A convex problem with bounds has a minimum if and only if no gradient points inwards at a bound and none is left
  /// between them.
  void boundedLinearProblemsAreSolvedExactly() {
    std::mt19937 random(3);
    int atBounds = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const Index count = 1 + trial % 9;
      const MatrixXd a = randomMatrix(count + 3, count, random);
      const VectorXd b = 3 * randomMatrix(count + 3, 1, random);
      const VectorXd lower = -randomMatrix(count, 1, random).cwiseAbs(),
                     upper = randomMatrix(count, 1, random).cwiseAbs();
      const VectorXd x = solvers::leastSquaresWithinBounds(a, b, lower, upper);
      const VectorXd gradient = a.transpose() * (a * x - b);
      for (Index i = 0; i < count; ++i) {
        QVERIFY(x[i] >= lower[i] && x[i] <= upper[i]);
        if (x[i] > lower[i]) QVERIFY(gradient[i] < 1e-10);
        if (x[i] < upper[i]) QVERIFY(gradient[i] > -1e-10);
        atBounds += x[i] == lower[i] || x[i] == upper[i];
      }
    }
    QVERIFY(atBounds > 200);
  }

  /// A line through points: the textbook's formulas for the errors of slope and intercept.
  void uncertaintyOfALine() {
    const VectorXd x = VectorXd::LinSpaced(12, 1, 9);
    std::mt19937 random(5);
    const VectorXd y = VectorXd::Constant(12, 2) + 0.7 * x + 0.1 * randomMatrix(12, 1, random);
    MatrixXd a(12, 2);
    a << VectorXd::Ones(12), x;
    const VectorXd line = a.colPivHouseholderQr().solve(y);
    const double squares = (a * line - y).squaredNorm();
    const auto found = solvers::parameterUncertainty(a, a.colwise().norm().transpose(), {0, 0}, squares, 0, 0.95);
    const double s2 = squares / 10, spread = (x.array() - x.mean()).square().sum();
    QCOMPARE(found.degreesOfFreedom, 10);
    QVERIFY(std::abs(found.residualDeviation - std::sqrt(s2)) < 1e-12);
    QVERIFY(std::abs(found.standardErrors[1] - std::sqrt(s2 / spread)) < 1e-12);
    QVERIFY(std::abs(found.standardErrors[0] - std::sqrt(s2 * (1.0 / 12 + x.mean() * x.mean() / spread))) < 1e-12);
    QVERIFY(std::abs(found.halfWidths[1] / found.standardErrors[1] - 2.228) < 5e-4);  // t of 10 degrees of freedom
    const double correlation = -x.mean() / std::sqrt(x.squaredNorm() / 12);
    QVERIFY(std::abs(found.correlation(0, 1) - correlation) < 1e-12);
    QCOMPARE(found.undetermined.cols(), Index(0));
  }

  /// Two columns that are multiples of each other cannot be told apart; the third parameter keeps its error.
  void namesWhatCannotBeToldApart() {
    std::mt19937 random(8);
    MatrixXd a = randomMatrix(20, 3, random);
    a.col(2) = -4 * a.col(0);
    const auto found = solvers::parameterUncertainty(a, a.colwise().norm().transpose(), {0, 0, 0}, 1, 0, 0.95);
    QCOMPARE(found.undetermined.cols(), Index(1));
    QVERIFY((a * found.undetermined).norm() < 1e-12);
    QVERIFY(std::abs(found.undetermined(0, 0) / found.undetermined(2, 0) - 4) < 1e-9);
    QVERIFY(std::isnan(found.standardErrors[0]) && std::isnan(found.standardErrors[2]));
    const MatrixXd alone = a.leftCols(2);
    const double expected = std::sqrt((alone.transpose() * alone).inverse()(1, 1) / 17);
    QVERIFY(std::abs(found.standardErrors[1] - expected) < 1e-12);
    // A parameter that is held counts as known.
    const auto held = solvers::parameterUncertainty(a, a.colwise().norm().transpose(), {1, 0, 0}, 1, 0, 0.95);
    QCOMPARE(held.undetermined.cols(), Index(0));
    QVERIFY(std::isnan(held.standardErrors[0]) && held.standardErrors[2] > 0);
    QCOMPARE(held.degreesOfFreedom, 18);
  }
};

QTEST_GUILESS_MAIN(TestBoundedLeastSquares)
#include "test_bounded_least_squares.moc"
