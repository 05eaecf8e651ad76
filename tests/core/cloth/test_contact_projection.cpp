#include <QTest>

#include "core/base/error.hpp"
#include "core/cloth/contact_projection.hpp"
#include "core/solvers/cone_certificate.hpp"
#include "tests/core/geometry/brute_force_intersections.hpp"
#include "tests/core/solvers/sheet_examples.hpp"

using namespace pliant::cloth;
using pliant::base::ExecutionContext;
using pliant::base::TerminationType;
using pliant::mechanics::ContactBarrier;
using pliant::mechanics::ContactGeometry;
using pliant::solvers::ConeSolution;
using pliant::tests::isotropicBound;
using pliant::tests::makeSheet;
using pliant::tests::Sheet;

namespace {

constexpr double radius = 0.25;
constexpr double range = 0.01;

std::vector<std::array<int, 3>> trianglesOf(const Sheet& sheet) {
  std::vector<std::array<int, 3>> triangles;
  for (const auto& element : sheet.constraints.elements) triangles.push_back(element.nodes);
  return triangles;
}

/// The sheet of side 1, which may touch itself, and one ball.
std::shared_ptr<ContactBarrier> makeBarrier(const Sheet& sheet) {
  ContactGeometry geometry;
  geometry.triangles = trianglesOf(sheet);
  const int nodes = sheet.constraints.nodeCount;
  geometry.points = {nodes};
  geometry.radii.assign(nodes + 1, 0);
  geometry.radii.back() = radius;
  geometry.bodies.assign(nodes + 1, 0);
  geometry.bodies.back() = 1;
  Eigen::Matrix3Xd rest(3, nodes + 1);
  rest << sheet.rest, Eigen::Vector3d(0.5, 0.5, -0.3);
  return std::make_shared<ContactBarrier>(
      geometry, rest, pliant::mechanics::ContactOptions{.range = range, .stiffness = 1, .separation = 0});
}

}  // namespace

class TestContactProjection : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// Far from everything it is the projection without contact.
  void equalsTheConeProgramWhereNothingTouches() {
    Sheet sheet = makeSheet(8);
    sheet.constraints.bounds = {isotropicBound(1.02)};
    const Eigen::Matrix3Xd candidate = pliant::tests::disturbed(sheet.rest, 0.1, 2);
    const Eigen::Matrix3Xd ball = Eigen::Vector3d(0, 0, -10);
    ExecutionContext context;
    pliant::solvers::ConeProgramOptions options;
    options.relativeGap = 1e-7;
    ContactProjection projection(sheet.constraints, makeBarrier(sheet));
    const ConeSolution near = projection.project(candidate, sheet.rest, {ball, ball}, 100, options, context);
    pliant::solvers::ConeProgram program(sheet.constraints);
    const ConeSolution exact = program.solve(candidate, sheet.rest, {}, context);
    QVERIFY2(near.report.converged(), near.report.message.c_str());
    QVERIFY(near.violation <= 0);
    QVERIFY(near.objective >= exact.bound);
    QVERIFY(near.objective <= exact.objective * (1 + 2e-7));
    QVERIFY(std::abs(near.relativeGap()) <= 2e-7);
  }

  /// A sheet falls on a ball, that then moves and pulls its corners along: at no time does it go through, and the
  /// limits hold.
  void neverIntersects() {
    const int cells = 12;
    Sheet sheet = makeSheet(cells);
    sheet.constraints.bounds = {isotropicBound(1.01)};
    ContactProjection projection(sheet.constraints, makeBarrier(sheet));
    Eigen::Matrix3Xd x = sheet.rest, velocity = Eigen::Matrix3Xd::Zero(3, x.cols());
    // Not quite flat, for whether coplanar triangles cross is a matter of rounding.
    x.row(2) = (1e-3 * (3 * x.row(0) + 5 * x.row(1)).array().sin() + 1e-3 * (7 * x.row(0)).array().cos()).matrix();
    Eigen::Vector3d ball(0.5, 0.5, -0.3);
    const double h = 0.02;
    ExecutionContext context;
    pliant::solvers::ConeProgramOptions options;
    options.relativeGap = 1e-5;
    const std::vector<std::array<int, 3>> triangles = trianglesOf(sheet);
    double nearest = 1;
    for (int step = 0; step < 40; ++step) {
      Eigen::Matrix3Xd candidate = x + h * velocity;
      candidate.row(2).array() -= 9.81 * h * h;
      const Eigen::Vector3d moved = ball + (step > 20 ? Eigen::Vector3d(0.004, 0, 0.008) : Eigen::Vector3d::Zero());
      const ConeSolution solution = projection.project(candidate, x, {ball, moved}, 1 / h, options, context);
      // Later, where it crumples, Newton's method may end before it is as near as asked; what follows holds all the
      // same.
      QVERIFY2(solution.report.converged(), solution.report.message.c_str());
      QCOMPARE(solution.violation, 0.0);
      // Where it falls freely the candidate keeps the limits, and there is no objective to compare with.
      QVERIFY2(std::abs(solution.gap()) <= 1e-4 * solution.objective + 1e-14,
               qPrintable(QString("%1 of %2 in step %3").arg(solution.gap()).arg(solution.objective).arg(step)));
      ball = moved;
      velocity = (solution.positions - x) / h;
      x = solution.positions;
      const double distance = distanceByBruteForce(x, triangles, ball);
      nearest = std::min(nearest, distance);
      QVERIFY2(distance > radius, qPrintable(QString::number(distance)));
      QCOMPARE(countIntersectionsByBruteForce(x, triangles), 0);
    }
    QVERIFY(nearest < radius + range);       // they did touch
    QVERIFY(x.row(2).minCoeff() < ball[2]);  // and the sheet hangs down around the ball
  }

  /// Pins that pull the sheet against a ball farther than it can stretch get stuck, and it is said so.
  void saysWhatCannotBe() {
    const int cells = 6;
    Sheet sheet = makeSheet(cells);
    sheet.constraints.bounds = {isotropicBound(1.01)};
    const int side = cells + 1;
    const int corners[] = {0, cells, cells * side, side * side - 1};
    for (const int node : corners) sheet.constraints.fixed[node] = 1;
    ContactProjection projection(sheet.constraints, makeBarrier(sheet));
    Eigen::Matrix3Xd candidate = sheet.rest;
    for (const int node : corners) candidate(2, node) -= 0.4;
    const Eigen::Matrix3Xd ball = Eigen::Vector3d(0.5, 0.5, -0.3);
    ExecutionContext context;
    const ConeSolution solution = projection.project(candidate, sheet.rest, {ball, ball}, 50, {}, context);
    QVERIFY(solution.report.termination == TerminationType::failed);
    QVERIFY(QString::fromStdString(solution.report.message).contains("cannot get on"));
    QVERIFY(distanceByBruteForce(solution.positions, trianglesOf(sheet), ball.col(0)) > radius);
    QCOMPARE(solution.violation, 0.0);
  }

  void refusesABadStart() {
    Sheet sheet = makeSheet(4);
    sheet.constraints.bounds = {isotropicBound(1.01)};
    ContactProjection projection(sheet.constraints, makeBarrier(sheet));
    ExecutionContext context;
    const Eigen::Matrix3Xd far = Eigen::Vector3d(0.5, 0.5, -1), inside = Eigen::Vector3d(0.5, 0.5, -0.1);
    QVERIFY_THROWS_EXCEPTION(
        pliant::base::InputError, projection.project(sheet.rest, 1.2 * sheet.rest, {far, far}, 50, {}, context));
    QVERIFY_THROWS_EXCEPTION(
        pliant::base::InputError, projection.project(sheet.rest, sheet.rest, {inside, inside}, 50, {}, context));
  }
};

QTEST_GUILESS_MAIN(TestContactProjection)
#include "test_contact_projection.moc"
