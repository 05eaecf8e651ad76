#include <Eigen/LU>
#include <QTest>
#include <functional>

#include "core/solvers/newton_solver.hpp"

using namespace pliant;
using base::TerminationType;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

class DenseSystem final : public solvers::NonlinearSystem {
 public:
  std::function<VectorXd(const VectorXd&)> function;
  std::function<MatrixXd(const VectorXd&)> jacobian;
  std::function<void()> onResidual = [] {};
  int linearizations = 0;

  VectorXd residual(const VectorXd& x) override {
    onResidual();
    return function(x);
  }
  bool linearize(const VectorXd& x, VectorXd& r) override {
    ++linearizations;
    r = function(x);
    lu_.compute(jacobian(x));
    return lu_.isInvertible();
  }
  VectorXd solve(const VectorXd& b) override { return lu_.solve(b); }

 private:
  Eigen::FullPivLU<MatrixXd> lu_;
};

VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const VectorXd>(values.begin(), static_cast<Eigen::Index>(values.size()));
}

/// Rosenbrock's function written as two equations; the root is (1, 1).
DenseSystem rosenbrock() {
  DenseSystem system;
  system.function = [](const VectorXd& x) { return vector({10 * (x[1] - x[0] * x[0]), 1 - x[0]}); };
  system.jacobian = [](const VectorXd& x) { return MatrixXd{{-20 * x[0], 10}, {-1, 0}}; };
  return system;
}

/// atan(x): full Newton steps diverge from |x| > 1.39.
DenseSystem arctangent() {
  DenseSystem system;
  system.function = [](const VectorXd& x) { return vector({std::atan(x[0])}); };
  system.jacobian = [](const VectorXd& x) { return MatrixXd{{1 / (1 + x[0] * x[0])}}; };
  return system;
}

}  // namespace

class TestNewtonSolver : public QObject {
  Q_OBJECT

 private slots:
  void findsARoot();
  void convergesQuadratically();
  void dampsStepsThatWouldDiverge();
  void rejectsStepsToWhereTheResidualIsNotFinite();
  void startThatIsNotFinite();
  void singularJacobian();
  void noRoot();
  void iterationLimit();
  void cancellation();
  void residualThatRoundingKeepsUp();
};

void TestNewtonSolver::findsARoot() {
  DenseSystem system = rosenbrock();
  base::ExecutionContext context;
  VectorXd x = vector({-1.2, 1});
  const base::SolverReport report = solvers::solveNewton(system, x, {}, context);
  QVERIFY(report.converged());
  QVERIFY(report.message.empty());
  QVERIFY((x - vector({1, 1})).norm() < 1e-9);
  QVERIFY(report.residual() <= 1e-9);
  QCOMPARE(report.iterations.front().iteration, 0);
  QCOMPARE(report.iterations.front().stepLength, 0.0);
  QCOMPARE(static_cast<int>(report.iterations.size()), system.linearizations + 1);
}

void TestNewtonSolver::convergesQuadratically() {
  DenseSystem system;  // x² = 2
  system.function = [](const VectorXd& x) { return vector({x[0] * x[0] - 2}); };
  system.jacobian = [](const VectorXd& x) { return MatrixXd{{2 * x[0]}}; };
  base::ExecutionContext context;
  VectorXd x = vector({2});
  solvers::NewtonOptions options;
  options.tolerance = 1e-14;
  const auto report = solvers::solveNewton(system, x, options, context);
  QVERIFY(report.converged());
  QVERIFY(std::abs(x[0] - std::sqrt(2.0)) < 1e-15);
  // r_{k+1} = r_k² / (4 x_k²) exactly.
  double at = 2;
  for (std::size_t k = 1; k < report.iterations.size() && report.iterations[k].residual > 1e-10; ++k) {
    const double before = at * at - 2;
    QVERIFY(std::abs(report.iterations[k].residual - before * before / (4 * at * at)) < 1e-12);
    at -= before / (2 * at);
  }
}

void TestNewtonSolver::dampsStepsThatWouldDiverge() {
  DenseSystem system = arctangent();
  base::ExecutionContext context;
  VectorXd x = vector({4});
  const auto report = solvers::solveNewton(system, x, {}, context);
  QVERIFY(report.converged());
  QVERIFY(std::abs(x[0]) < 1e-8);
  QVERIFY(report.iterations[1].stepLength < 1);
  QCOMPARE(report.iterations.back().stepLength, 1.0);
}

void TestNewtonSolver::rejectsStepsToWhereTheResidualIsNotFinite() {
  DenseSystem system;  // log x = -3: the full step from 2 leads to x < 0
  system.function = [](const VectorXd& x) { return vector({std::log(x[0]) + 3}); };
  system.jacobian = [](const VectorXd& x) { return MatrixXd{{1 / x[0]}}; };
  base::ExecutionContext context;
  VectorXd x = vector({2});
  const auto report = solvers::solveNewton(system, x, {}, context);
  QVERIFY(report.converged());
  QVERIFY(std::abs(x[0] - std::exp(-3.0)) < 1e-9);
}

void TestNewtonSolver::startThatIsNotFinite() {
  DenseSystem system = arctangent();
  base::ExecutionContext context;
  VectorXd x = vector({std::nan("")});
  QVERIFY(solvers::solveNewton(system, x, {}, context).termination == base::TerminationType::failed);
}

void TestNewtonSolver::singularJacobian() {
  DenseSystem system = rosenbrock();
  system.jacobian = [](const VectorXd&) { return MatrixXd::Zero(2, 2); };
  base::ExecutionContext context;
  VectorXd x = vector({3, 3});
  const auto report = solvers::solveNewton(system, x, {}, context);
  QVERIFY(report.termination == base::TerminationType::failed);
  QVERIFY(x == vector({3, 3}));
  QVERIFY(report.message.find("singular") != std::string::npos);
}

void TestNewtonSolver::noRoot() {
  DenseSystem system;  // x² + 1
  system.function = [](const VectorXd& x) { return vector({x[0] * x[0] + 1}); };
  system.jacobian = [](const VectorXd& x) { return MatrixXd{{2 * x[0]}}; };
  base::ExecutionContext context;
  VectorXd x = vector({3});
  const auto report = solvers::solveNewton(system, x, {}, context);
  QVERIFY(!report.converged());
  QVERIFY(!report.message.empty());
}

void TestNewtonSolver::iterationLimit() {
  DenseSystem system = rosenbrock();
  base::ExecutionContext context;
  VectorXd x = vector({-1.2, 1});
  solvers::NewtonOptions options;
  options.maximumIterations = 1;
  const auto report = solvers::solveNewton(system, x, options, context);
  QVERIFY(report.termination == base::TerminationType::iterationLimit);
  QCOMPARE(report.iterations.size(), 2u);
}

void TestNewtonSolver::cancellation() {
  base::ExecutionContext context;
  DenseSystem system = arctangent();
  int evaluations = 0;
  system.onResidual = [&] {
    if (++evaluations == 2) context.requestCancel();
  };
  VectorXd x = vector({1});
  const auto report = solvers::solveNewton(system, x, {}, context);
  QVERIFY(report.termination == base::TerminationType::cancelled);
  QCOMPARE(report.iterations.size(), 2u);  // what was reached is kept
  QVERIFY(std::abs(x[0]) < 1);
}

void TestNewtonSolver::residualThatRoundingKeepsUp() {
  // A stiff and a soft equation whose sum is rounded: the residual cannot fall below 1e-16 * 1e12, x converges all the
  // same.
  DenseSystem system;
  system.function = [](const VectorXd& x) {
    const double stiff = 1e12 * (x[0] - 0.1 - 1e-3 * x[1] * x[1]);
    return vector({stiff, 1e-3 * (x[1] - 0.2) + 1e-3 * std::pow(x[1], 3)});
  };
  system.jacobian = [](const VectorXd& x) { return MatrixXd{{1e12, -2e9 * x[1]}, {0, 1e-3 + 3e-3 * x[1] * x[1]}}; };
  base::ExecutionContext context;
  VectorXd x = vector({0, 1});
  solvers::NewtonOptions options;
  options.tolerance = 1e-12;
  const auto report = solvers::solveNewton(system, x, options, context);
  QVERIFY(report.converged());
  QVERIFY(std::abs(x[1] + std::pow(x[1], 3) - 0.2) < 1e-12);
}

QTEST_GUILESS_MAIN(TestNewtonSolver)
#include "test_newton_solver.moc"
