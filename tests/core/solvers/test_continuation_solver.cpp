#include <Eigen/LU>
#include <QTest>
#include <functional>
#include <numbers>

#include "core/solvers/continuation_solver.hpp"

using namespace pliant;
using base::TerminationType;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using solvers::BranchEvent;
using solvers::BranchPoint;

namespace {

class DenseProblem final : public solvers::ContinuationProblem {
 public:
  std::function<VectorXd(const VectorXd&, double)> function;
  std::function<MatrixXd(const VectorXd&, double)> byState;
  std::function<VectorXd(const VectorXd&, double)> byParameter;
  std::function<VectorXd(const BranchPoint&)> monitor = [](const BranchPoint&) { return VectorXd(); };

  VectorXd residual(const VectorXd& x, double parameter) override { return function(x, parameter); }
  double residualScale(double) override { return 1; }
  VectorXd linearize(const VectorXd& x, double parameter) override {
    jacobian_ = byState(x, parameter);
    return byParameter(x, parameter);
  }
  VectorXd multiply(const VectorXd& v) override { return jacobian_ * v; }
  bool factorize() override {
    lu_.compute(jacobian_);
    return jacobian_.allFinite() && lu_.determinant() != 0;
  }
  VectorXd solve(const VectorXd& b) override { return lu_.solve(b); }
  VectorXd monitors(const BranchPoint& point) override { return monitor(point); }

 private:
  MatrixXd jacobian_;
  Eigen::PartialPivLU<MatrixXd> lu_;
};

VectorXd scalar(double value) { return VectorXd::Constant(1, value); }

/// λ = 3 x - x³ + offset: folds at x = -1 (λ = -2) and x = 1 (λ = 2), both relative to the offset.
DenseProblem cubic(double offset) {
  DenseProblem problem;
  problem.function = [=](const VectorXd& x, double l) { return scalar(3 * x[0] - std::pow(x[0], 3) + offset - l); };
  problem.byState = [](const VectorXd& x, double) { return MatrixXd::Constant(1, 1, 3 - 3 * x[0] * x[0]); };
  problem.byParameter = [](const VectorXd&, double) { return scalar(-1); };
  return problem;
}

struct Traced {
  BranchPoint point;
  BranchEvent event;
  int monitor;
};

struct Trace {
  base::SolverReport report;
  std::vector<Traced> points;

  std::vector<BranchPoint> of(BranchEvent event) const {
    std::vector<BranchPoint> result;
    for (const Traced& t : points)
      if (t.event == event) result.push_back(t.point);
    return result;
  }
};

Trace follow(DenseProblem& problem, const solvers::ContinuationOptions& options, const VectorXd& x, double parameter,
             int cancelAfter = -1) {
  Trace trace;
  base::ExecutionContext context;
  solvers::ContinuationSolver solver(problem, options);
  trace.report = solver.trace(x, parameter, context, [&](const BranchPoint& point, BranchEvent event, int monitor) {
    trace.points.push_back({point, event, monitor});
    if (static_cast<int>(trace.points.size()) == cancelAfter) context.requestCancel();
  });
  return trace;
}

/// x where 3 x - x³ = λ, on the outer branch that is not folded back.
double outerRoot(double lambda) {
  double x = lambda > 0 ? -2.5 : 2.5;
  for (int i = 0; i < 60; ++i) x -= (3 * x - x * x * x - lambda) / (3 - 3 * x * x);
  return x;
}

}  // namespace

class TestContinuationSolver : public QObject {
  Q_OBJECT

 private slots:
  void followsThroughFoldsInBothDirections();
  void endsExactlyOnTheBounds();
  void foldOutsideTheRangeEndsTheBranch();
  void tangentsAreUnitAndTrue();
  void monitorsAreLocated();
  void smallStepsWhereTheBranchTurnsSharply();
  void staysOnItsBranch();
  void closedCurve();
  void limits();
  void cancellation();
  void wrongStart();
};

void TestContinuationSolver::followsThroughFoldsInBothDirections() {
  DenseProblem problem = cubic(100);
  solvers::ContinuationOptions options;
  options.lower = 96.5;
  options.upper = 103.5;
  options.parameterScale = 3;
  for (const double orientation : {1.0, -1.0}) {
    // Upwards along λ from below, the branch begins where x is large; downwards from above, where x is small.
    options.orientation = orientation;
    const double begin = orientation > 0 ? options.lower : options.upper;
    const Trace trace = follow(problem, options, scalar(outerRoot(begin - 100)), begin);
    QVERIFY(trace.report.converged());
    const std::vector<BranchPoint> folds = trace.of(BranchEvent::fold);
    QCOMPARE(folds.size(), 2u);
    // dλ/dx < 0 for |x| > 1, so rising λ leads to falling x: the fold met first lies at x = 1.
    QVERIFY(std::abs(folds[0].parameter - (100 + 2 * orientation)) < 1e-6 * 100);
    QVERIFY(std::abs(folds[1].parameter - (100 - 2 * orientation)) < 1e-6 * 100);
    QVERIFY(std::abs(folds[0].x[0] - orientation) < 1e-3);
    const double end = trace.points.back().point.parameter;
    QCOMPARE(end, orientation > 0 ? options.upper : options.lower);
    QVERIFY(std::abs(trace.points.back().point.x[0] - outerRoot(end - 100)) < 1e-8);
  }
}

void TestContinuationSolver::endsExactlyOnTheBounds() {
  DenseProblem problem;  // x = exp(λ)
  problem.function = [](const VectorXd& x, double l) { return scalar(x[0] - std::exp(l)); };
  problem.byState = [](const VectorXd&, double) { return MatrixXd::Ones(1, 1); };
  problem.byParameter = [](const VectorXd&, double l) { return scalar(-std::exp(l)); };
  solvers::ContinuationOptions options;
  options.lower = -1.234;
  options.upper = 2.345;
  for (const double orientation : {1.0, -1.0}) {
    options.orientation = orientation;
    const double begin = orientation > 0 ? options.lower : options.upper;
    const Trace trace = follow(problem, options, scalar(std::exp(begin)), begin);
    QVERIFY(trace.report.converged());
    const BranchPoint& last = trace.points.back().point;
    QCOMPARE(last.parameter, orientation > 0 ? options.upper : options.lower);
    QVERIFY(std::abs(last.x[0] - std::exp(last.parameter)) < 1e-8);
    for (const Traced& t : trace.points) QVERIFY(std::abs(t.point.x[0] - std::exp(t.point.parameter)) < 1e-8);
  }
}

void TestContinuationSolver::foldOutsideTheRangeEndsTheBranch() {
  DenseProblem problem = cubic(0);
  solvers::ContinuationOptions options;
  options.lower = -3;
  options.upper = 1.9999;  // just below the fold at 2, so that one step can lead around it
  options.initialStep = 0.2;
  options.targetAngle = 0.5;
  const Trace trace = follow(problem, options, scalar(outerRoot(-3)), -3);
  QVERIFY(trace.report.converged());
  QCOMPARE(trace.points.back().point.parameter, options.upper);
  QVERIFY(trace.of(BranchEvent::fold).empty() || trace.of(BranchEvent::fold)[0].parameter < options.upper);
}

void TestContinuationSolver::tangentsAreUnitAndTrue() {
  DenseProblem problem = cubic(0);
  solvers::ContinuationOptions options;
  options.lower = -3;
  options.upper = 3;
  options.stateScale = 2;
  options.parameterScale = 5;
  const Trace trace = follow(problem, options, scalar(outerRoot(-3)), -3);
  double previous = -1;
  for (const Traced& t : trace.points) {
    const BranchPoint& p = t.point;
    QVERIFY(std::abs(std::hypot(p.direction[0] / 2, p.parameterDirection / 5) - 1) < 1e-12);
    // A tangent that only predicts is as good as the prediction.
    const double slope = 3 - 3 * p.x[0] * p.x[0];
    QVERIFY(std::abs(slope * p.direction[0] - p.parameterDirection) < 1e-3);
    QVERIFY(p.arcLength > previous);
    previous = p.arcLength;
  }
  // The arc length is that of the scaled curve (λ(x) / 5, x / 2), integrated here along x.
  double length = 0;
  const int count = 20000;
  const double from = trace.points.front().point.x[0], to = trace.points.back().point.x[0];
  for (int i = 0; i < count; ++i) {
    const double x = from + (to - from) * (i + 0.5) / count;
    length += std::hypot((3 - 3 * x * x) / 5, 0.5) * std::abs(to - from) / count;
  }
  QVERIFY(std::abs(trace.points.back().point.arcLength - length) < 1e-2 * length);
}

void TestContinuationSolver::monitorsAreLocated() {
  DenseProblem problem;  // x = sin λ; the monitor dx/ds vanishes at π/2, 5π/2, ... from above
  problem.function = [](const VectorXd& x, double l) { return scalar(x[0] - std::sin(l)); };
  problem.byState = [](const VectorXd&, double) { return MatrixXd::Ones(1, 1); };
  problem.byParameter = [](const VectorXd&, double l) { return scalar(-std::cos(l)); };
  problem.monitor = [](const BranchPoint& p) {
    VectorXd values(2);
    values << 1.0, p.direction[0];
    return values;
  };
  solvers::ContinuationOptions options;
  options.upper = 10;
  options.maximumParameterStep = 0.5;
  const Trace trace = follow(problem, options, scalar(0), 0);
  QVERIFY(trace.report.converged());
  const auto peaks = trace.of(BranchEvent::monitor);
  QCOMPARE(peaks.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const double expected = (0.5 + 2 * i) * std::numbers::pi;
    QVERIFY(std::abs(peaks[i].parameter - expected) < 1e-6 * expected);
  }
  for (const Traced& t : trace.points) QCOMPARE(t.monitor, t.event == BranchEvent::monitor ? 1 : -1);
}

void TestContinuationSolver::smallStepsWhereTheBranchTurnsSharply() {
  // x = tanh(500 (λ - ½)): flat, then steep, then flat.
  DenseProblem problem;
  problem.function = [](const VectorXd& x, double l) { return scalar(x[0] - std::tanh(500 * (l - 0.5))); };
  problem.byState = [](const VectorXd&, double) { return MatrixXd::Ones(1, 1); };
  problem.byParameter = [](const VectorXd&, double l) {
    return scalar(-500 / std::pow(std::cosh(500 * (l - 0.5)), 2));
  };
  solvers::ContinuationOptions options;
  const Trace trace = follow(problem, options, scalar(std::tanh(-250)), 0);
  QVERIFY(trace.report.converged());
  QCOMPARE(trace.points.back().point.parameter, 1.0);
  for (std::size_t i = 1; i < trace.points.size(); ++i) {
    const double cosine = trace.points[i].point.direction.dot(trace.points[i - 1].point.direction) +
                          trace.points[i].point.parameterDirection * trace.points[i - 1].point.parameterDirection;
    QVERIFY(cosine > std::cos(options.maximumAngle + 1e-9));
  }
}

void TestContinuationSolver::staysOnItsBranch() {
  // Two branches, x = 0.02 and x = -0.02 + 0.03 exp(-((λ - ½)/0.01)²), come within 0.01 of each other.
  const auto lower = [](double l) { return -0.02 + 0.03 * std::exp(-std::pow((l - 0.5) / 0.01, 2)); };
  const auto slope = [](double l) { return 0.03 * std::exp(-std::pow((l - 0.5) / 0.01, 2)) * (-2 * (l - 0.5) / 1e-4); };
  DenseProblem problem;
  problem.function = [=](const VectorXd& x, double l) { return scalar((x[0] - 0.02) * (x[0] - lower(l))); };
  problem.byState = [=](const VectorXd& x, double l) {
    return MatrixXd::Constant(1, 1, (x[0] - 0.02) + (x[0] - lower(l)));
  };
  problem.byParameter = [=](const VectorXd& x, double l) { return scalar(-(x[0] - 0.02) * slope(l)); };
  solvers::ContinuationOptions options;
  options.tolerance = 1e-12;
  options.stateScale = 0.02;
  options.maximumParameterStep = 0.004;  // a hill narrower than a step is stepped over
  const Trace trace = follow(problem, options, scalar(lower(0)), 0);
  QVERIFY(trace.report.converged());
  double highest = -1;
  for (const Traced& t : trace.points) {
    QVERIFY(std::abs(t.point.x[0] - lower(t.point.parameter)) < 1e-6);
    highest = std::max(highest, t.point.x[0]);
  }
  QVERIFY(highest > 0);  // it did climb the hill
}

void TestContinuationSolver::closedCurve() {
  // The circle x² + λ² = 1 never leaves [-2, 2]: it is followed once around.
  DenseProblem problem;
  problem.function = [](const VectorXd& x, double l) { return scalar(x[0] * x[0] + l * l - 1); };
  problem.byState = [](const VectorXd& x, double) { return MatrixXd::Constant(1, 1, 2 * x[0]); };
  problem.byParameter = [](const VectorXd&, double l) { return scalar(2 * l); };
  solvers::ContinuationOptions options;
  options.lower = -2;
  options.upper = 2;
  options.maximumPoints = 150;
  const Trace trace = follow(problem, options, scalar(1), 0);
  QVERIFY(trace.report.converged());
  QVERIFY(trace.points.size() < 150);
  QCOMPARE(trace.points.back().point.x[0], trace.points.front().point.x[0]);
  QCOMPARE(trace.points.back().point.parameter, trace.points.front().point.parameter);
  QVERIFY(std::abs(trace.points.back().point.arcLength - 2 * std::numbers::pi) < 1e-4);
  for (const Traced& t : trace.points) QVERIFY(std::abs(std::hypot(t.point.x[0], t.point.parameter) - 1) < 1e-8);
  const auto folds = trace.of(BranchEvent::fold);
  QCOMPARE(folds.size(), 2u);
  for (const BranchPoint& fold : folds) QVERIFY(std::abs(std::abs(fold.parameter) - 1) < 1e-6);
  // On the unit circle the arc length is the angle.
  QVERIFY(std::abs(folds[1].arcLength - folds[0].arcLength - std::numbers::pi) < 1e-4);
}

void TestContinuationSolver::limits() {
  DenseProblem problem = cubic(0);
  solvers::ContinuationOptions options;
  options.lower = -3;
  options.upper = 3;
  options.maximumStep = 0.05;
  options.maximumParameterStep = 0.02;
  const Trace trace = follow(problem, options, scalar(outerRoot(-3)), -3);
  QVERIFY(trace.report.converged());
  QCOMPARE(trace.report.iterations.size(), trace.points.size());
  for (std::size_t i = 1; i < trace.points.size(); ++i) {
    QVERIFY(trace.points[i].point.arcLength - trace.points[i - 1].point.arcLength < 0.05 * 1.1);
    QVERIFY(std::abs(trace.points[i].point.parameter - trace.points[i - 1].point.parameter) < 0.02 * 1.5);
  }
}

void TestContinuationSolver::cancellation() {
  DenseProblem problem = cubic(0);
  solvers::ContinuationOptions options;
  options.lower = -3;
  options.upper = 3;
  const Trace trace = follow(problem, options, scalar(outerRoot(-3)), -3, 5);
  QVERIFY(trace.report.termination == base::TerminationType::cancelled);
  QCOMPARE(trace.points.size(), 5u);
  QVERIFY(!trace.report.message.empty());
}

void TestContinuationSolver::wrongStart() {
  DenseProblem problem = cubic(0);
  problem.byState = [](const VectorXd&, double) { return MatrixXd::Zero(1, 1); };
  const Trace trace = follow(problem, {}, scalar(0.7), 0.5);
  QVERIFY(trace.report.termination == base::TerminationType::failed);
  QVERIFY(trace.points.empty());
}

QTEST_GUILESS_MAIN(TestContinuationSolver)
#include "test_continuation_solver.moc"
