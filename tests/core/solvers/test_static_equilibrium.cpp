#include <QRegularExpression>
#include <QTest>

#include "core/mechanics/spring.hpp"
#include "core/solvers/static_equilibrium.hpp"

using namespace pliant;
using mechanics::Model;
using mechanics::Vector;

namespace {

/// Springs in a row along x; node 0 is locked, the others free in 2 dimensions.
std::shared_ptr<Model> row(int nodes, double stiffness, double restLength) {
  auto model = std::make_shared<Model>();
  model->dimension = 2;
  model->restPositions = Vector::Zero(2 * nodes);
  for (int i = 0; i < nodes; ++i) model->restPositions[2 * i] = i;
  model->gravity = Vector::Zero(2);
  model->lockedCoordinates.assign(2 * nodes, 0);
  model->lockedCoordinates[0] = model->lockedCoordinates[1] = 1;
  for (int i = 0; i + 1 < nodes; ++i)
    model->energies.push_back(mechanics::makeSpring(2, i, i + 1, restLength, {{stiffness}}));
  model->pointMasses = {{"mass", {1}, 1, 0, 1}};
  return model;
}

solvers::StaticEquilibrium solve(std::shared_ptr<Model> model, const Vector& force) {
  model->finish();
  const mechanics::ElasticAssembler assembler(model);
  base::ExecutionContext context;
  return solvers::solveStaticEquilibrium(*model, assembler, model->restPositions, force, {}, context);
}

}  // namespace

class TestStaticEquilibrium : public QObject {
  Q_OBJECT

 private slots:
  void stretchedRow();
  void hangingNet();
  void toggleThatSnapsThrough();
  void slackNetIsRefused();
  void cancellation();
};

void TestStaticEquilibrium::stretchedRow() {
  // Pretension (rest length 0.9) holds the row sideways; the end is pulled and pushed aside.
  auto model = row(3, 50, 0.9);
  Vector force = Vector::Zero(6);
  force[4] = 30;
  force[5] = 4;
  const auto equilibrium = solve(model, force);
  QVERIFY(equilibrium.report.converged());
  // Both springs carry the force's magnitude along its direction.
  const double length = 0.9 + std::hypot(30, 4) / 50;
  const Eigen::Vector2d direction = Eigen::Vector2d(30, 4).normalized();
  QVERIFY((equilibrium.positions.segment<2>(2) - length * direction).norm() < 1e-9);
  QVERIFY((equilibrium.positions.segment<2>(4) - 2 * length * direction).norm() < 1e-9);
}

void TestStaticEquilibrium::hangingNet() {
  // A row that is held at both ends and hardly taut turns into a hanging chain: far from its rest shape.
  auto model = row(3, 1e4, 0.9999);
  model->lockedCoordinates[4] = model->lockedCoordinates[5] = 1;
  Vector force = Vector::Zero(6);
  force[3] = -500;
  const auto equilibrium = solve(model, force);
  QVERIFY2(equilibrium.report.converged(), equilibrium.report.message.c_str());
  const double depth = -equilibrium.positions[3];
  const double length = std::hypot(1, depth);
  QVERIFY(std::abs(2 * 1e4 * (length - 0.9999) * depth / length - 500) < 1e-5);
  QVERIFY(std::abs(equilibrium.positions[2] - 1) < 1e-9);
}

void TestStaticEquilibrium::toggleThatSnapsThrough() {
  // A shallow truss that is pushed beyond its snap-through load: Newton's method from rest meets a singular stiffness.
  auto model = std::make_shared<Model>();
  model->dimension = 2;
  model->restPositions = (Vector(6) << -1, 0, 0, 0.2, 1, 0).finished();
  model->gravity = Vector::Zero(2);
  model->lockedCoordinates = {1, 1, 0, 0, 1, 1};
  const double rest = std::hypot(1, 0.2);
  model->energies = {mechanics::makeSpring(2, 0, 1, rest, {{1000}}), mechanics::makeSpring(2, 1, 2, rest, {{1000}})};
  model->pointMasses = {{"top", {1}, 1, 0, 1}};
  Vector force = Vector::Zero(6);
  force[3] = -20;
  const auto equilibrium = solve(model, force);
  QVERIFY2(equilibrium.report.converged(), equilibrium.report.message.c_str());
  const double height = equilibrium.positions[3];
  const double length = std::hypot(1, height);
  QVERIFY(std::abs(2 * 1000 * (length - rest) * height / length + 20) < 1e-6);
}

void TestStaticEquilibrium::slackNetIsRefused() {
  const auto equilibrium = solve(row(4, 50, 1), Vector::Zero(8));
  QVERIFY(equilibrium.report.termination == base::TerminationType::failed);
  const QString message = QString::fromStdString(equilibrium.report.message);
  QVERIFY2(message.contains(QRegularExpression("Nothing holds node [123] along y")), qPrintable(message));
  QVERIFY(message.contains("2 more nodes"));
}

void TestStaticEquilibrium::cancellation() {
  auto model = row(3, 50, 0.9);
  model->finish();
  const mechanics::ElasticAssembler assembler(model);
  base::ExecutionContext context;
  context.requestCancel();
  Vector force = Vector::Zero(6);
  force[4] = 30;
  const auto equilibrium = solvers::solveStaticEquilibrium(*model, assembler, model->restPositions, force, {}, context);
  QVERIFY(equilibrium.report.termination == base::TerminationType::cancelled);
}

QTEST_GUILESS_MAIN(TestStaticEquilibrium)
#include "test_static_equilibrium.moc"
