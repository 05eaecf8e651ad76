#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <QTest>
#include <limits>
#include <set>

#include "core/base/error.hpp"
#include "core/math/parallel.hpp"
#include "core/solvers/cone_certificate.hpp"
#include "tests/core/solvers/sheet_examples.hpp"

using namespace pliant::solvers;
using pliant::base::ExecutionContext;
using pliant::base::InputError;
using pliant::base::TerminationType;
using pliant::tests::directionBounds;
using pliant::tests::disturbed;
using pliant::tests::isotropicBound;
using pliant::tests::makeSheet;
using pliant::tests::Sheet;

namespace {

ConeSolution project(const Sheet& sheet, const Eigen::Matrix3Xd& candidate, double relativeGap = 1e-8) {
  ConeProgram program(sheet.constraints);
  ExecutionContext context;
  ConeProgramOptions options;
  options.relativeGap = relativeGap;
  return program.solve(candidate, sheet.rest, options, context);
}

/// The certificate computed anew from positions and multipliers, by code that shares nothing with the solver.
ConeSolution certified(const Sheet& sheet, const Eigen::Matrix3Xd& candidate, const ConeSolution& solution) {
  ConeSolution checked = solution;
  certify(sheet.constraints, candidate, checked);
  return checked;
}

double largestStretch(const ConeConstraints& constraints, const Eigen::Matrix3Xd& x, int node = -1) {
  double largest = 0;
  for (const ConeElement& element : constraints.elements) {
    if (node >= 0 && std::find(element.nodes.begin(), element.nodes.end(), node) == element.nodes.end()) continue;
    Eigen::Matrix<double, 3, 2> f = Eigen::Matrix<double, 3, 2>::Zero();
    for (int k = 0; k < 3; ++k) f += x.col(element.nodes[k]) * element.weights[k].transpose();
    for (const Eigen::Matrix2d& s : constraints.bounds[element.bounds].ellipses) {
      const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(f.transpose() * f, s);
      largest = std::max(largest, std::sqrt(solver.eigenvalues()[1]));
    }
    for (const Eigen::Vector2d& v : constraints.bounds[element.bounds].directions)
      largest = std::max(largest, (f * v).norm());
  }
  return largest;
}

}  // namespace

class TestConeProgram : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void isOptimal_data() {
    QTest::addColumn<int>("cells");
    QTest::addColumn<int>("kind");
    QTest::addColumn<double>("limit");
    for (const int cells : {1, 3, 10, 24})
      for (const double limit : {0.2, 0.01, 0.001})
        for (const int kind : {0, 1, 2, 4, 18})
          QTest::addRow("%d cells, %g, kind %d", cells, limit, kind) << cells << kind << limit;
  }

  /// Kinds: 0 isotropic, 1 one ellipse, 2 two ellipses, otherwise so many directions.
  void isOptimal() {
    QFETCH(int, cells);
    QFETCH(int, kind);
    QFETCH(double, limit);
    Sheet sheet = makeSheet(cells);
    const Eigen::Matrix2d along = Eigen::Vector2d(std::pow(1 + limit, 2), std::pow(1 + 5 * limit, 2)).asDiagonal();
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.4).toRotationMatrix();
    MetricBounds bounds = isotropicBound(1 + limit);
    if (kind == 1) bounds = {{turn * along * turn.transpose()}, {}};
    if (kind == 2) bounds = {{along, turn * along * turn.transpose()}, {}};
    if (kind > 2) bounds = directionBounds(1 + limit, kind);
    sheet.constraints.bounds = {bounds};
    sheet.constraints.fixed[0] = sheet.constraints.fixed[cells] = 1;
    Eigen::Matrix3Xd candidate = disturbed(sheet.rest, 0.3, 7);
    candidate.col(0) = sheet.rest.col(0);
    candidate.col(cells) = sheet.rest.col(cells);

    const ConeSolution solution = project(sheet, candidate);
    QCOMPARE(solution.report.message, std::string());
    const ConeSolution checked = certified(sheet, candidate, solution);
    QVERIFY(checked.objective > 1e-4);
    QVERIFY2(std::abs(checked.relativeGap()) <= 1e-8, qPrintable(QString::number(checked.relativeGap())));
    QVERIFY(checked.violation <= 1e-9);
    QVERIFY(std::abs(checked.complementarity) <= 1e-7);
    QVERIFY2(checked.dualResidual <= 1.01e-8, qPrintable(QString::number(checked.dualResidual)));
    QVERIFY(std::abs(checked.objective - solution.objective) <= 1e-12 * checked.objective);
    QVERIFY(std::abs(checked.bound - solution.bound) <= 1e-10 * checked.objective);
    QVERIFY((checked.multipliers - solution.multipliers).norm() <= 1e-12 * checked.multipliers.norm());
    QVERIFY(std::abs(largestStretch(sheet.constraints, solution.positions) - 1) <= 1e-6);  // a limit is active
    for (Eigen::Index i = 0; i < solution.ellipseMultipliers.cols(); ++i) {
      const auto m = solution.ellipseMultipliers.col(i);
      QVERIFY(m[0] >= 0 && m[1] >= 0 && m[0] * m[1] - m[2] * m[2] >= -1e-15 * m[0] * m[1]);
    }
    QVERIFY(solution.directionMultipliers.size() == 0 || solution.directionMultipliers.minCoeff() >= 0);
    QVERIFY(solution.positions.col(0) == candidate.col(0));
  }

  /// Of an equilateral triangle with equal masses the nearest shape has the same singular vectors, and singular values
  /// cut off at the limit.
  void cutsSingularValuesOff() {
    Sheet sheet;
    sheet.rest.resize(3, 3);
    for (int k = 0; k < 3; ++k) sheet.rest.col(k) << std::cos(2 * M_PI * k / 3), std::sin(2 * M_PI * k / 3), 0;
    Eigen::Matrix2d edges;
    edges << (sheet.rest.col(1) - sheet.rest.col(0)).head<2>(), (sheet.rest.col(2) - sheet.rest.col(0)).head<2>();
    const Eigen::Matrix2d inverse = edges.inverse();
    const Eigen::Vector2d one = inverse.row(0).transpose(), two = inverse.row(1).transpose();
    sheet.constraints = {3,
                         {{{0, 1, 2}, {Eigen::Vector2d(-one - two), one, two}, 0}},
                         {isotropicBound(1.05)},
                         Eigen::Vector3d::Constant(2),
                         {0, 0, 0}};
    for (const double second : {0.7, 1.02, 1.3}) {
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
      const Eigen::Matrix2d inPlane = Eigen::Rotation2Dd(0.3).toRotationMatrix();
      const auto mapped = [&](double a, double b) {
        const Eigen::Matrix<double, 3, 2> f =
            turn.leftCols<2>() * Eigen::Vector2d(a, b).asDiagonal() * inPlane.transpose();
        return Eigen::Matrix3Xd((f * sheet.rest.topRows<2>()).colwise() + Eigen::Vector3d(1, 2, 3));
      };
      const ConeSolution solution = project(sheet, mapped(1.4, second), 1e-10);
      QVERIFY(solution.report.converged());
      QVERIFY((solution.positions - mapped(1.05, std::min(1.05, second))).norm() < 1e-5);
    }
  }

  void leavesWhatKeepsTheLimitsAlone() {
    Sheet sheet = makeSheet(5);
    sheet.constraints.bounds = {isotropicBound(1.1)};
    const Eigen::Matrix3Xd candidate = 1.05 * sheet.rest;
    const ConeSolution solution = project(sheet, candidate);
    QVERIFY(solution.report.converged());
    QVERIFY(solution.positions == candidate);
    QCOMPARE(solution.objective, 0.0);
    QCOMPARE(solution.multipliers.norm(), 0.0);
    QCOMPARE(int(solution.multipliers.cols()), 50);
  }

  /// Whatever direction a vertex is moved in: what lowers the objective breaks a limit.
  void noVertexCanBeMovedNearer() {
    const int cells = 12;
    Sheet sheet = makeSheet(cells);
    sheet.constraints.bounds = {isotropicBound(1.01)};
    const Eigen::Matrix3Xd candidate = disturbed(sheet.rest, 0.2, 3);
    const ConeSolution solution = project(sheet, candidate, 1e-10);
    QVERIFY(solution.report.converged());
    std::mt19937 generator(1);
    std::normal_distribution<double> normal;
    int tried = 0;
    for (int node = 0; node < sheet.constraints.nodeCount; ++node)
      for (int attempt = 0; attempt < 20; ++attempt) {
        const Eigen::Vector3d pull = (candidate.col(node) - solution.positions.col(node)).normalized();
        Eigen::Vector3d direction = Eigen::Vector3d(normal(generator), normal(generator), normal(generator));
        if (attempt == 0) direction = pull;
        direction.normalize();
        if (direction.dot(pull) < 0.1) continue;
        const double step = 1e-4;
        Eigen::Matrix3Xd moved = solution.positions;
        moved.col(node) += step * direction;
        // The objective falls by m |x̂ - x| step cos, of first order; so a limit must be broken by as much.
        QVERIFY(largestStretch(sheet.constraints, moved, node) > 1 + 1e-2 * step);
        ++tried;
      }
    QVERIFY(tried > 1000);
  }

  /// Internal forces: the mass-weighted projection of free cloth changes neither momentum.
  void keepsMomentum() {
    const int cells = 20;
    Sheet sheet = makeSheet(cells);
    sheet.constraints.bounds = {isotropicBound(1.01)};
    std::mt19937 generator(5);
    for (double& mass : sheet.constraints.masses) mass *= 0.5 + static_cast<double>(generator() % 1000) / 1000;
    const Eigen::Matrix3Xd candidate = disturbed(sheet.rest, 0.2, 4);
    ConeProgram program(sheet.constraints);
    ExecutionContext context;
    ConeProgramOptions options;
    options.relativeGap = 1e-13;
    const ConeSolution solution = program.solve(candidate, sheet.rest, options, context);
    const Eigen::Matrix3Xd impulse = (solution.positions - candidate) * sheet.constraints.masses.asDiagonal();
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    double size = 0;
    for (int node = 0; node < sheet.constraints.nodeCount; ++node) {
      turn += solution.positions.col(node).cross(impulse.col(node));
      size += impulse.col(node).norm();
    }
    QVERIFY2(impulse.rowwise().sum().norm() <= 1e-10 * size,
             qPrintable(QString::number(impulse.rowwise().sum().norm() / size)));
    QVERIFY2(turn.norm() <= 1e-10 * size, qPrintable(QString::number(turn.norm() / size)));
  }

  void recognisesContradictions() {
    const int cells = 10, side = cells + 1;
    Sheet sheet = makeSheet(cells);
    sheet.constraints.bounds = {isotropicBound(1.05)};
    // Three pins, of which the first two are too far apart.
    for (const int node : {0, cells, cells * side}) sheet.constraints.fixed[node] = 1;
    for (const double excess : {0.001, 0.05, 1.0}) {
      Eigen::Matrix3Xd candidate = sheet.rest;
      candidate(0, cells) = 1.05 + excess;
      const ConeSolution solution = project(sheet, candidate);
      QVERIFY2(solution.report.termination == TerminationType::infeasible, solution.report.message.c_str());
      QVERIFY(!solution.report.message.empty());
      QCOMPARE(solution.conflictingNodes.size(), std::size_t(2));
      QVERIFY(std::set<int>(solution.conflictingNodes.begin(), solution.conflictingNodes.end()) ==
              (std::set<int>{0, cells}));
      QVERIFY(!solution.conflictingElements.empty());
      // The straight row between the two pins bears it.
      const ConeElement& worst = sheet.constraints.elements[solution.conflictingElements.front()];
      QVERIFY(std::count_if(worst.nodes.begin(), worst.nodes.end(), [&](int node) { return node <= cells; }) >= 2);
    }
    // A candidate that is stretched evenly with them is no excuse.
    Eigen::Matrix3Xd evenly = sheet.rest;
    evenly.row(0) *= 2;
    const ConeSolution stretched = project(sheet, evenly);
    QVERIFY2(stretched.report.termination == TerminationType::infeasible, stretched.report.message.c_str());
    Eigen::Matrix3Xd candidate = sheet.rest;
    candidate(0, cells) = 1.049;  // nearly taut, but possible
    QVERIFY(project(sheet, candidate).report.converged());
  }

  void warmAndColdStartsAgree() {
    Sheet sheet = makeSheet(16);
    sheet.constraints.bounds = {isotropicBound(1.02)};
    ConeProgram program(sheet.constraints);
    ExecutionContext context;
    ConeProgramOptions options;
    program.solve(disturbed(sheet.rest, 0.2, 1), sheet.rest, options, context);
    const Eigen::Matrix3Xd candidate = disturbed(sheet.rest, 0.21, 1);
    const ConeSolution warm = program.solve(candidate, sheet.rest, options, context);
    const ConeSolution cold = project(sheet, candidate);
    QVERIFY(warm.report.converged() && cold.report.converged());
    const Eigen::VectorXd offsets = (warm.positions - cold.positions).colwise().squaredNorm();
    const double distance = std::sqrt(offsets.dot(sheet.constraints.masses));
    // Each is within sqrt(2 (P - D)) of the optimum.
    QVERIFY(distance <= std::sqrt(2 * std::abs(warm.gap())) + std::sqrt(2 * std::abs(cold.gap())));
    QVERIFY(warm.report.iterations.size() < cold.report.iterations.size());
  }

  void doesNotDependOnTheThreads() {
    Sheet sheet = makeSheet(40);
    sheet.constraints.bounds = {isotropicBound(1.02)};
    std::vector<Eigen::Matrix3Xd> results;
    for (const int threads : {1, 2, 3}) {
      pliant::math::setThreadCount(threads);
      results.push_back(project(sheet, disturbed(sheet.rest, 0.1, 1)).positions);
    }
    pliant::math::setThreadCount(0);
    QVERIFY(results[0] == results[1]);
    QVERIFY(results[0] == results[2]);
  }

  void stopsWhenCancelled() {
    Sheet sheet = makeSheet(4);
    sheet.constraints.bounds = {isotropicBound(1.02)};
    ConeProgram program(sheet.constraints);
    ExecutionContext context;
    context.requestCancel();
    const ConeSolution solution = program.solve(disturbed(sheet.rest, 0.2, 1), sheet.rest, {}, context);
    QVERIFY(solution.report.termination == TerminationType::cancelled);
  }

  void refusesBadInput() {
    Sheet sheet = makeSheet(2);
    sheet.constraints.bounds = {isotropicBound(1.02)};
    ConeProgram program(sheet.constraints);
    ExecutionContext context;
    Eigen::Matrix3Xd candidate = sheet.rest;
    candidate(1, 3) = std::numeric_limits<double>::quiet_NaN();
    QVERIFY_THROWS_EXCEPTION(InputError, program.solve(candidate, sheet.rest, {}, context));
    QVERIFY_THROWS_EXCEPTION(InputError, program.solve(sheet.rest.leftCols(3), sheet.rest, {}, context));
    ConeConstraints constraints = sheet.constraints;
    constraints.masses[4] = 0;
    QVERIFY_THROWS_EXCEPTION(InputError, ConeProgram{constraints});
    constraints = sheet.constraints;
    constraints.elements[1].nodes[2] = 9;
    QVERIFY_THROWS_EXCEPTION(InputError, ConeProgram{constraints});
    constraints = sheet.constraints;
    constraints.bounds[0].ellipses[0](0, 0) = -1;
    QVERIFY_THROWS_EXCEPTION(InputError, ConeProgram{constraints});
  }
};

QTEST_GUILESS_MAIN(TestConeProgram)
#include "test_cone_program.moc"
