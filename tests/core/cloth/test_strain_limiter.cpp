#include "core/cloth/strain_limiter.hpp"

#include <Eigen/Geometry>
#include <QTest>
#include <random>

#include "core/base/error.hpp"
#include "core/solvers/cone_certificate.hpp"
#include "tests/core/cloth/limit_examples.hpp"
#include "tests/core/solvers/sheet_examples.hpp"

using namespace pliant::test;
using pliant::base::ExecutionContext;
using pliant::base::InputError;
using pliant::base::TerminationType;
using pliant::solvers::ConeConstraints;
using pliant::solvers::ConeSolution;
using pliant::tests::disturbed;
using pliant::tests::makeSheet;

namespace {

/// A sheet with one limit, held at two corners, and positions that are to be projected.
struct Projection {
  ConeConstraints constraints;
  Eigen::Matrix3Xd start, candidate;
};

Projection projection(int cells, const LimitConstraints& limit, double amount = 0.2) {
  pliant::tests::Sheet sheet = makeSheet(cells);
  LimitedSheet limited;
  limited.nodeCount = sheet.constraints.nodeCount;
  limited.masses = sheet.constraints.masses;
  limited.fixed = sheet.constraints.fixed;
  limited.fixed[0] = limited.fixed[cells] = 1;
  limited.limits = {IsotropicLimit{1}};  // what sheetCones takes is the constraints alone
  limited.constraints = {limit};
  for (const auto& element : sheet.constraints.elements)
    limited.triangles.push_back({element.nodes, element.weights, 0});
  Projection result{
      sheetCones(limited, ProjectionNorm::mass).constraints, sheet.rest, disturbed(sheet.rest, amount, 7)};
  for (const int node : {0, cells}) result.candidate.col(node) = sheet.rest.col(node);
  return result;
}

ConeSolution solve(const char* method, const Projection& problem, ProjectionOptions options = {}) {
  options.cone.relativeGap = 1e-10;
  ExecutionContext context;
  return makeStrainLimiter(method, problem.constraints, options)->project(problem.candidate, problem.start, context);
}

double distance(const Projection& problem, const ConeSolution& a, const ConeSolution& b) {
  const Eigen::VectorXd squares = (a.positions - b.positions).colwise().squaredNorm();
  return std::sqrt(squares.dot(problem.constraints.masses));
}

/// The optimum's multipliers at other positions x. Since P(x) + ½ Σ ⟨Λ, C' - I⟩ is least at the optimum, and grows from
/// there by at least ½ ‖x - x*‖²_M, the half square of the distance is at most `lead` - D.
struct Comparison {
  ConeSolution checked;  ///< positions x
  double lead;           ///< P(x) + ½ Σ ⟨Λ, C' - I⟩
};

Comparison compare(const Projection& problem, const ConeSolution& optimum, const Eigen::Matrix3Xd& positions) {
  Comparison result{optimum, 0};
  result.checked.positions = positions;
  pliant::solvers::certify(problem.constraints, problem.candidate, result.checked);
  result.lead = result.checked.objective * (1 - result.checked.complementarity);
  return result;
}

std::vector<std::pair<const char*, LimitConstraints>> limits() {
  return {{"isotropic", exactConstraints(IsotropicLimit{1.05})},
          {"orthotropic", exactConstraints(OrthotropicLimit{1.02, 1.15, 0.4})},
          {"four directions", directionConstraints(IsotropicLimit{1.05}, 4)},
          {"eighteen directions", directionConstraints(OrthotropicLimit{1.02, 1.15, 0.4}, 18)},
          {"curve", limitConstraints(LimitCurve(curves()[0].points), 6)}};
}

}  // namespace

class TestStrainLimiter : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void deformationIsTheIdentityAtRest() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto vector = [&] { return Eigen::Vector3d(number(random), number(random), number(random)); };
    for (int i = 0; i < 200; ++i) {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k) corners.col(k) = vector();
      const Eigen::Vector3d normal =
          (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
      const Eigen::Vector3d direction = vector();
      const Eigen::Vector3d inPlane = (direction - direction.dot(normal) * normal).normalized();
      const SheetTriangle triangle{{0, 1, 2}, shapeGradients(corners, direction), 0};
      const Eigen::Matrix<double, 3, 2> f = deformationGradient(triangle, corners);
      const Eigen::Matrix3d edges = corners.colwise() - corners.col(0);
      const double condition = edges.colwise().squaredNorm().sum() / edges.col(1).cross(edges.col(2)).norm();
      const double rounding = 1e-14 * condition;  // of a 2 x 2 inverse
      QVERIFY((f.col(0) - inPlane).norm() <= rounding);
      QVERIFY((f.col(1) - normal.cross(inPlane)).norm() <= rounding);
      // Any map of the plane is found again, wherever it puts the triangle.
      Eigen::Matrix<double, 3, 2> map;
      map << vector(), vector();
      Eigen::Matrix<double, 2, 3> material;
      material << inPlane.transpose() * corners, normal.cross(inPlane).transpose() * corners;
      const Eigen::Matrix3Xd moved = (map * material).colwise() + vector();
      QVERIFY((deformationGradient(triangle, moved) - map).norm() <= 4 * rounding);
    }
  }

  void refusesTrianglesWithoutAreaOrDirection() {
    Eigen::Matrix3d corners = Eigen::Matrix3d::Identity();
    const Eigen::Vector3d normal(1, 1, 1);
    shapeGradients(corners, Eigen::Vector3d::UnitX());  // this one is well
    QVERIFY_THROWS_EXCEPTION(InputError, shapeGradients(corners, normal));
    QVERIFY_THROWS_EXCEPTION(InputError, shapeGradients(corners, Eigen::Vector3d::Zero()));
    corners.col(2) = 0.3 * corners.col(0) + 0.7 * corners.col(1);
    QVERIFY_THROWS_EXCEPTION(InputError, shapeGradients(corners, Eigen::Vector3d::UnitX()));
    corners.col(2) = corners.col(0);
    QVERIFY_THROWS_EXCEPTION(InputError, shapeGradients(corners, Eigen::Vector3d::UnitX()));
    corners(0, 0) = std::numeric_limits<double>::quiet_NaN();
    QVERIFY_THROWS_EXCEPTION(InputError, shapeGradients(corners, Eigen::Vector3d::UnitX()));
  }

  void stretchesAreThoseOfTheWorstDirection() {
    const pliant::tests::Sheet base = makeSheet(6);
    LimitedSheet sheet;
    sheet.limits = {IsotropicLimit{1.1}, OrthotropicLimit{1.05, 1.3, 0.3}};
    for (const NamedCurve& curve : curves()) sheet.limits.push_back(LimitCurve(curve.points));
    const int kinds = static_cast<int>(sheet.limits.size());
    for (std::size_t t = 0; t < base.constraints.elements.size(); ++t)
      sheet.triangles.push_back({base.constraints.elements[t].nodes, base.constraints.elements[t].weights,
                                 static_cast<int>(t) % (kinds + 1) - 1});
    const Eigen::Matrix3Xd x = disturbed(base.rest, 0.3, 5);
    const Eigen::VectorXd ratios = stretchRatios(sheet, x), reached = reachedStretch(sheet, x, 12);
    QCOMPARE(ratios.size(), Eigen::Index(72));
    Eigen::VectorXd expectedReach = Eigen::VectorXd::Zero(12), someReach = expectedReach;
    for (int t = 0; t < 72; ++t) {
      const Eigen::Matrix<double, 3, 2> f = deformationGradient(sheet.triangles[t], x);
      for (int i = 0; i < 12; ++i) {
        expectedReach[i] = std::max(expectedReach[i], (f * directionAt(pi * i / 12)).norm());
        if (t == 3 || t == 50) someReach[i] = std::max(someReach[i], (f * directionAt(pi * i / 12)).norm());
      }
      const int limit = sheet.triangles[t].limit;
      if (limit < 0) {
        QCOMPARE(ratios[t], 0.0);
        continue;
      }
      const double brute = Grid(sheet.limits[limit], 40'000).excess(f.transpose() * f) + 1;
      // Nothing in between is higher by more than ½ (π / 80 000)² = 8e-10 times the second derivative: of |Fd|² at most
      // 4 |F|² < 20, of the curves (about whose points the grid is finer still) 6 * 0.3 / 0.17² = 60 outside the
      // notches.
      QVERIFY2(ratios[t] >= brute - 1e-14 && ratios[t] <= brute + 8e-10 * 80,
               qPrintable(QString("%1 %2").arg(limit).arg(ratios[t] - brute)));
    }
    QVERIFY((reached - expectedReach).cwiseAbs().maxCoeff() <= 1e-14);
    QVERIFY((reachedStretch(sheet, x, 12, {3, 50}) - someReach).cwiseAbs().maxCoeff() <= 1e-14);
    // At rest, to the last digit: not half of them.
    for (const double ratio :
         {stretchRatios({0, {{{0, 1, 7}, base.constraints.elements[0].weights, 0}}, {IsotropicLimit{1}}, {}, {}, {}},
                        base.rest)[0]})
      QVERIFY(std::abs(ratio - 1) <= 1e-14);
  }

  void conesHaveAnElementForEachLimitedTriangle() {
    const pliant::tests::Sheet base = makeSheet(2);
    LimitedSheet sheet{9, {}, {IsotropicLimit{1.1}, LimitCurve(curves()[0].points)}, {}, base.constraints.masses, {}};
    sheet.fixed.assign(9, 0);
    sheet.fixed[4] = 1;
    sheet.constraints = {exactConstraints(sheet.limits[0]), directionConstraints(sheet.limits[1], 4)};
    for (int t = 0; t < 8; ++t)
      sheet.triangles.push_back({base.constraints.elements[t].nodes, base.constraints.elements[t].weights, t % 3 - 1});
    const SheetCones cones = sheetCones(sheet, ProjectionNorm::mass);
    QVERIFY(cones.triangles == std::vector<int>({1, 2, 4, 5, 7}));
    QCOMPARE(cones.constraints.elements.size(), std::size_t(5));
    for (int e = 0; e < 5; ++e) {
      const SheetTriangle& triangle = sheet.triangles[cones.triangles[e]];
      QVERIFY(cones.constraints.elements[e].nodes == triangle.nodes);
      QVERIFY(cones.constraints.elements[e].weights == triangle.gradients);
      QCOMPARE(cones.constraints.elements[e].bounds, triangle.limit);
    }
    QCOMPARE(cones.constraints.nodeCount, 9);
    QVERIFY(cones.constraints.fixed == sheet.fixed);
    QVERIFY(cones.constraints.masses == sheet.masses);
    QVERIFY(sheetCones(sheet, ProjectionNorm::identity).constraints.masses == Eigen::VectorXd::Ones(9));
    QVERIFY(cones.constraints.bounds[0].ellipses[0].isApprox(1.21 * Eigen::Matrix2d::Identity(), 1e-15));
    for (int i = 0; i < 4; ++i)
      QVERIFY(
          (cones.constraints.bounds[1].directions[i] - directionAt(pi * i / 4) / stretchAt(sheet.limits[1], pi * i / 4))
              .norm() <= 1e-15);
  }

  void methodsAgreeOnTheOptimum_data() {
    QTest::addColumn<int>("limit");
    QTest::addColumn<int>("cells");
    for (int limit = 0; limit < int(limits().size()); ++limit)
      for (const int cells : {1, 4}) QTest::addRow("%s, %d cells", limits()[limit].first, cells) << limit << cells;
  }

  void methodsAgreeOnTheOptimum() {
    QFETCH(int, limit);
    QFETCH(int, cells);
    const Projection problem = projection(cells, limits()[limit].second);
    const ConeSolution cone = solve("cone", problem);
    QVERIFY2(cone.report.converged(), cone.report.message.c_str());
    const ConeSolution ipopt = solve("nonlinear_program", problem);
    QVERIFY(!ipopt.report.iterations.empty());
    if (ipopt.report.converged()) {
      // Ipopt loosens bounds by 1e-8 and keeps them to 1e-8. A determinant (1 - λ₁)(1 - λ₂) >= -2e-8 with a trace of 2
      // lets a squared stretch λ be above 1 by the root of that.
      const bool ellipses = !limits()[limit].second.ellipses.empty();
      QVERIFY2(ipopt.violation <= (ellipses ? 0.5 * std::sqrt(2e-8) + 3e-8 : 2e-8),
               qPrintable(QString::number(ipopt.violation)));
      const double lead = compare(problem, cone, ipopt.positions).lead;
      const double allowed = std::sqrt(2 * std::max(0.0, lead - cone.bound)) + std::sqrt(2 * std::abs(cone.gap()));
      const double offset = std::sqrt(2 * cone.objective), apart = distance(problem, cone, ipopt);
      qInfo("apart %.1e of the offset, allowed %.1e", apart / offset, allowed / offset);
      QVERIFY(apart <= allowed);
      QVERIFY(allowed <= 0.01 * offset);                    // or else it would say nothing
      QVERIFY(ipopt.bound <= cone.objective * (1 + 1e-9));  // its own certificate holds for the optimum as well
      agreed_ += 1;
    } else {
      QVERIFY(!ipopt.report.message.empty());
      qInfo("%s", ipopt.report.message.c_str());
    }

    const ConeSolution sweeps = solve("gauss_seidel", problem);
    QVERIFY2(sweeps.report.converged(), sweeps.report.message.c_str());
    QVERIFY(sweeps.violation <= 1e-6);
    // By code that shares nothing with Gauss-Seidel.
    const auto [checked, lead] = compare(problem, cone, sweeps.positions);
    QVERIFY(std::abs(checked.violation - sweeps.violation) <= 1e-12);
    QVERIFY(std::abs(checked.objective - sweeps.objective) <= 1e-12 * sweeps.objective);
    QVERIFY(lead >= cone.bound);
    QCOMPARE(sweeps.bound, -std::numeric_limits<double>::infinity());
    QCOMPARE(int(sweeps.multipliers.cols()), 0);
    QVERIFY(sweeps.positions.col(0) == problem.candidate.col(0));
    qInfo("Gauss-Seidel: objective %.2f %% above the optimum, %d sweeps", 100 * (sweeps.objective / cone.objective - 1),
          sweeps.report.iterations.back().iteration);
    if (cells == 4) QVERIFY(sweeps.objective >= 1.001 * cone.objective);  // it does not find the nearest point
  }

  void ipoptAgreedSomewhere() { QVERIFY2(agreed_ >= 8, qPrintable(QString::number(agreed_))); }

  void sweepsAreLimited() {
    const Projection problem = projection(8, exactConstraints(IsotropicLimit{1.01}));
    ProjectionOptions options;
    options.sweeps = 3;
    const ConeSolution solution = solve("gauss_seidel", problem, options);
    QVERIFY(solution.report.termination == TerminationType::iterationLimit);
    QVERIFY(!solution.report.message.empty());
    QVERIFY(solution.violation > options.violation);
    QCOMPARE(solution.report.iterations.back().iteration, 3);
    const ConeSolution checked = compare(problem, solve("cone", problem), solution.positions).checked;
    QVERIFY(std::abs(checked.violation - solution.violation) <= 1e-12);
  }

  void everyMethodStopsWhenCancelled() {
    const Projection problem = projection(4, exactConstraints(IsotropicLimit{1.01}));
    for (const char* method : {"cone", "gauss_seidel", "nonlinear_program"}) {
      ExecutionContext context;
      context.requestCancel();
      const auto limiter = makeStrainLimiter(method, problem.constraints, {});
      QCOMPARE(QString::fromStdString(std::string(limiter->name())), QString(method));
      const ConeSolution solution = limiter->project(problem.candidate, problem.start, context);
      QVERIFY2(solution.report.termination == TerminationType::cancelled, method);
      QVERIFY(!solution.report.message.empty());
    }
  }

  void everyMethodRefusesBadNumbers() {
    const Projection problem = projection(2, exactConstraints(IsotropicLimit{1.01}));
    Eigen::Matrix3Xd broken = problem.candidate;
    broken(1, 3) = std::numeric_limits<double>::quiet_NaN();
    ExecutionContext context;
    for (const char* method : {"cone", "gauss_seidel", "nonlinear_program"}) {
      const auto limiter = makeStrainLimiter(method, problem.constraints, {});
      QVERIFY_THROWS_EXCEPTION(InputError, limiter->project(broken, problem.start, context));
      QVERIFY_THROWS_EXCEPTION(InputError, limiter->project(problem.candidate.leftCols(4), problem.start, context));
    }
    QVERIFY_THROWS_EXCEPTION(InputError, makeStrainLimiter("newton", problem.constraints, {}));
    QVERIFY_THROWS_EXCEPTION(InputError, makeStrainLimiter("", problem.constraints, {}));
  }

 private:
  int agreed_ = 0;
};

QTEST_GUILESS_MAIN(TestStrainLimiter)
#include "test_strain_limiter.moc"
