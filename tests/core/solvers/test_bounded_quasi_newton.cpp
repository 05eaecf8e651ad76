#include <QTest>
#include <cmath>
#include <numbers>
#include <random>

#include "core/solvers/bounded_quasi_newton.hpp"

using namespace pliant;
using Eigen::VectorXd;
using solvers::BoundedQuasiNewtonOptions;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

VectorXd vectorOf(std::initializer_list<double> values) {
  VectorXd vector(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), vector.begin());
  return vector;
}

using Function = std::function<std::optional<double>(const VectorXd&, VectorXd&)>;

class Lambda final : public solvers::BoundedObjective {
 public:
  explicit Lambda(Function function) : function_(std::move(function)) {}
  std::optional<double> evaluate(const VectorXd& x, VectorXd& gradient) override {
    ++evaluations;
    return function_(x, gradient);
  }
  int evaluations = 0;

 private:
  Function function_;
};

BoundedQuasiNewtonOptions tight() {
  BoundedQuasiNewtonOptions options;
  options.maximumIterations = 2000;
  options.gradientTolerance = 1e-10;
  options.valueTolerance = 0;
  return options;
}

/// A problem of Hock and Schittkowski (1981) whose only constraints are bounds, with its solution in closed form.
struct Problem {
  const char* name;
  Function function;
  VectorXd start, lower, upper, solution;
};

std::optional<double> rosenbrock(const VectorXd& x, VectorXd& gradient) {
  const double a = x[1] - x[0] * x[0], b = 1 - x[0];
  gradient = vectorOf({-400 * a * x[0] - 2 * b, 200 * a});
  return 100 * a * a + b * b;
}

std::vector<Problem> problems() {
  const double a = std::sqrt(598.0 / 1200), b = 400 * a * a * a;
  const double secondX = 2 * a * std::cos(std::acos(1 / b) / 3);
  const double pi = std::numbers::pi;
  return {
      {"Rosenbrock, bound not met", rosenbrock, vectorOf({-2, 1}), vectorOf({-infinity, -1.5}),
       vectorOf({infinity, infinity}), vectorOf({1, 1})},
      {"Rosenbrock, bound met", rosenbrock, vectorOf({2, 4}), vectorOf({0, 1.5}), vectorOf({infinity, infinity}),
       vectorOf({secondX, 1.5})},
      {"valley along a bound",
       [](const VectorXd& x, VectorXd& g) {
         const double d = x[1] - x[0];
         g = vectorOf({-2e-5 * d, 1 + 2e-5 * d});
         return std::optional(x[1] + 1e-5 * d * d);
       },
       vectorOf({10, 1}), vectorOf({-infinity, 0}), vectorOf({infinity, infinity}), vectorOf({0, 0})},
      {"corner",
       [](const VectorXd& x, VectorXd& g) {
         g = vectorOf({(x[0] + 1) * (x[0] + 1), 1});
         return std::optional(std::pow(x[0] + 1, 3) / 3 + x[1]);
       },
       vectorOf({1.125, 0.125}), vectorOf({1, 0}), vectorOf({infinity, infinity}), vectorOf({1, 0})},
      {"interior",
       [](const VectorXd& x, VectorXd& g) {
         const double sum = x[0] + x[1], d = x[0] - x[1];
         g = vectorOf({std::cos(sum) + 2 * d - 1.5, std::cos(sum) - 2 * d + 2.5});
         return std::optional(std::sin(sum) + d * d - 1.5 * x[0] + 2.5 * x[1] + 1);
       },
       vectorOf({0, 0}), vectorOf({-1.5, -3}), vectorOf({4, 3}), vectorOf({-pi / 3 + 0.5, -pi / 3 - 0.5})},
      {"product",
       [](const VectorXd& x, VectorXd& g) {
         const double product = x.prod();
         g = -product / 120 * x.cwiseInverse();
         return std::optional(2 - product / 120);
       },
       vectorOf({0.5, 1, 1, 1, 2}), VectorXd::Constant(5, 1e-3), vectorOf({1, 2, 3, 4, 5}), vectorOf({1, 2, 3, 4, 5})},
  };
}

}  // namespace

class TestBoundedQuasiNewton : public QObject {
  Q_OBJECT

 private slots:
  void findsKnownMinima_data();
  void findsKnownMinima();
  void solvesLargeQuadratics_data();
  void solvesLargeQuadratics();
  void fixedVariablesStay();
  void shortensStepsWhereThereIsNoValue();
  void saysWhyItEnds();
  void everyIterateIsReportedAndLower();
};

void TestBoundedQuasiNewton::findsKnownMinima_data() {
  QTest::addColumn<int>("index");
  const auto list = problems();
  for (std::size_t i = 0; i < list.size(); ++i) QTest::newRow(list[i].name) << static_cast<int>(i);
}

void TestBoundedQuasiNewton::findsKnownMinima() {
  QFETCH(int, index);
  const Problem problem = problems()[static_cast<std::size_t>(index)];
  Lambda objective(problem.function);
  base::ExecutionContext context;
  VectorXd x = problem.start;
  const auto report = solvers::minimizeWithinBounds(objective, x, problem.lower, problem.upper, tight(), context);
  QVERIFY2(report.converged(), report.message.c_str());
  QVERIFY((x.array() >= problem.lower.array()).all() && (x.array() <= problem.upper.array()).all());
  const double error = (x - problem.solution).cwiseAbs().maxCoeff();
  QVERIFY2(error < 1e-5, qPrintable(QString("%1 after %2").arg(error).arg(objective.evaluations)));
  QVERIFY2(objective.evaluations < 100, qPrintable(QString::number(objective.evaluations)));
}

void TestBoundedQuasiNewton::solvesLargeQuadratics_data() {
  QTest::addColumn<int>("atBounds");
  for (const int percent : {0, 50, 90}) QTest::addRow("%d %% at bounds", percent) << percent;
}

/// ½ (x-s)ᵀQ(x-s) + mᵀ(x-s) of 500 variables, condition 10⁴: the minimum within the bounds is s, since the gradient m
/// there vanishes but for multipliers of the right sign at bounds.
void TestBoundedQuasiNewton::solvesLargeQuadratics() {
  QFETCH(int, atBounds);
  constexpr int n = 500;
  std::mt19937 random(static_cast<unsigned>(3 + atBounds));
  std::uniform_real_distribution<double> unit(0, 1);
  VectorXd diagonal(n), solution(n), multipliers = VectorXd::Zero(n);
  const VectorXd lower = VectorXd::Constant(n, -1), upper = VectorXd::Constant(n, 1);
  for (int i = 0; i < n; ++i) {
    diagonal[i] = std::pow(10, 4 * unit(random));
    solution[i] = 1.8 * unit(random) - 0.9;
    if (unit(random) >= atBounds / 100.0) continue;
    const bool above = unit(random) < 0.5;
    solution[i] = above ? 1 : -1;
    multipliers[i] = (above ? -1 : 1) * diagonal[i] * (0.1 + unit(random));
  }
  const VectorXd u = VectorXd::NullaryExpr(n, [&] { return unit(random) - 0.5; });
  const auto times = [&](const VectorXd& x) { return VectorXd(diagonal.cwiseProduct(x) + 50 * u.dot(x) * u); };
  Lambda objective([&](const VectorXd& x, VectorXd& gradient) {
    const VectorXd offset = x - solution, product = times(offset);
    gradient = product + multipliers;
    return std::optional(0.5 * offset.dot(product) + multipliers.dot(offset));
  });
  base::ExecutionContext context;
  VectorXd x = VectorXd::Zero(n);
  BoundedQuasiNewtonOptions options = tight();
  options.gradientTolerance = 1e-9;
  const auto report = solvers::minimizeWithinBounds(objective, x, lower, upper, options, context);
  QVERIFY2(report.converged(), report.message.c_str());
  const double error = (x - solution).cwiseAbs().maxCoeff();
  QVERIFY2(error < 1e-5, qPrintable(QString("%1 after %2").arg(error).arg(objective.evaluations)));
  for (int i = 0; i < n; ++i)
    if (multipliers[i] != 0) QCOMPARE(x[i], solution[i]);
}

void TestBoundedQuasiNewton::fixedVariablesStay() {
  Lambda objective(rosenbrock);
  base::ExecutionContext context;
  VectorXd x = vectorOf({5, 7});
  const auto report =
      solvers::minimizeWithinBounds(objective, x, vectorOf({0.5, -9}), vectorOf({0.5, 9}), tight(), context);
  QVERIFY(report.converged());
  QCOMPARE(x[0], 0.5);
  QVERIFY(std::abs(x[1] - 0.25) < 1e-9);
}

/// -log of the distances to two walls that have no value beyond: the minimum lies between them.
void TestBoundedQuasiNewton::shortensStepsWhereThereIsNoValue() {
  Lambda objective([](const VectorXd& x, VectorXd& gradient) -> std::optional<double> {
    const double left = x[0] + 1, right = 3 - x[0];
    if (!(left > 0 && right > 0)) return std::nullopt;
    gradient = vectorOf({-1 / left + 1 / right + 0.0, 2e3 * x[1]});
    return -std::log(left) - std::log(right) + 1e3 * x[1] * x[1];
  });
  base::ExecutionContext context;
  VectorXd x = vectorOf({-1 + 1e-6, 0.3});
  BoundedQuasiNewtonOptions options = tight();
  options.firstStep = 50;
  const auto report =
      solvers::minimizeWithinBounds(objective, x, vectorOf({-100, -1}), vectorOf({100, 1}), options, context);
  QVERIFY2(report.converged(), report.message.c_str());
  QVERIFY((x - vectorOf({1, 0})).norm() < 1e-5);
}

void TestBoundedQuasiNewton::saysWhyItEnds() {
  const VectorXd wide = VectorXd::Constant(2, 10);
  base::ExecutionContext context;
  Lambda objective(rosenbrock);
  BoundedQuasiNewtonOptions options = tight();
  options.maximumIterations = 3;
  VectorXd x = vectorOf({-2, 1}), gradient;
  const double start = *rosenbrock(x, gradient);
  QVERIFY(solvers::minimizeWithinBounds(objective, x, -wide, wide, options, context).termination ==
          base::TerminationType::iterationLimit);
  QVERIFY(*rosenbrock(x, gradient) < start);

  Lambda nowhere([](const VectorXd&, VectorXd&) { return std::optional<double>(); });
  QVERIFY(solvers::minimizeWithinBounds(nowhere, x, -wide, wide, options, context).termination ==
          base::TerminationType::failed);

  // A gradient that points the wrong way.
  Lambda wrong([](const VectorXd& at, VectorXd& g) {
    const auto value = rosenbrock(at, g);
    g = -g;
    return value;
  });
  x = vectorOf({-2, 1});
  QVERIFY(solvers::minimizeWithinBounds(wrong, x, -wide, wide, tight(), context).termination ==
          base::TerminationType::failed);
  QVERIFY(x == vectorOf({-2, 1}));

  int left = 5;
  Lambda cancelling([&](const VectorXd& at, VectorXd& g) {
    if (--left == 0) context.requestCancel();
    return rosenbrock(at, g);
  });
  const auto report = solvers::minimizeWithinBounds(cancelling, x, -wide, wide, tight(), context);
  QVERIFY(report.termination == base::TerminationType::cancelled);
  QCOMPARE(cancelling.evaluations, 5);
  QVERIFY_EXCEPTION_THROWN(
      solvers::minimizeWithinBounds(objective, x, wide, -wide, options, context), std::invalid_argument);
}

void TestBoundedQuasiNewton::everyIterateIsReportedAndLower() {
  Lambda objective(rosenbrock);
  base::ExecutionContext context;
  VectorXd x = vectorOf({-1.2, 1}), last;
  double previous = infinity;
  int count = 0;
  const auto report = solvers::minimizeWithinBounds(objective, x, VectorXd::Constant(2, -5), VectorXd::Constant(2, 5),
                                                    tight(), context, [&](const solvers::BoundedIterate& iterate) {
                                                      QCOMPARE(iterate.iteration, count++);
                                                      QVERIFY(iterate.value < previous);
                                                      previous = iterate.value;
                                                      last = iterate.x;
                                                    });
  QVERIFY(report.converged());
  QCOMPARE(static_cast<int>(report.iterations.size()), count);
  QVERIFY(last == x);
}

QTEST_GUILESS_MAIN(TestBoundedQuasiNewton)
#include "test_bounded_quasi_newton.moc"
