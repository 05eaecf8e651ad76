#include <Eigen/Eigenvalues>
#include <QTest>

#include "core/harmonic/linear_modes.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::LinearModes;

namespace {

constexpr double pi = std::numbers::pi;

std::shared_ptr<Model> points(int dimension, const Vector& positions) {
  auto model = std::make_shared<Model>();
  model->dimension = dimension;
  model->restPositions = positions;
  model->lockedCoordinates.assign(positions.size(), 0);
  return model;
}

/// `count` equal masses between two walls, joined by equal springs, on a line.
std::shared_ptr<Model> uniformChain(int count, double stiffness, double mass) {
  auto model = points(1, Vector::LinSpaced(count, 1, count));
  model->energies.push_back(mechanics::makeAnchoredSpring(1, 0, Vector::Zero(1), 1, {{stiffness}}));
  for (int i = 0; i + 1 < count; ++i) model->energies.push_back(mechanics::makeSpring(1, i, i + 1, 1, {{stiffness}}));
  model->energies.push_back(
      mechanics::makeAnchoredSpring(1, count - 1, Vector::Constant(1, count + 1), 1, {{stiffness}}));
  for (int i = 0; i < count; ++i) addPointMass(*model, "mass", {i}, mass);
  return model;
}

LinearModes modesOf(const std::shared_ptr<Model>& model, int count) {
  model->finish();
  base::ExecutionContext context;
  return harmonic::computeLinearModes(harmonic::HarmonicBalanceProblem(model, {1, 16}), {.count = count}, context);
}

Matrix shapesOf(const LinearModes& modes) {
  Matrix shapes(modes.modes.front().shape.size(), static_cast<Eigen::Index>(modes.modes.size()));
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) shapes.col(i) = modes.modes[static_cast<std::size_t>(i)].shape;
  return shapes;
}

}  // namespace

class TestLinearModes : public QObject {
  Q_OBJECT

 private slots:
  void chainAgreesWithClosedForm_data();
  void chainAgreesWithClosedForm();
  void masslessNodesFollowTheOthers();
  void weightTightensAPendulum();
  void shellAgreesWithADenseSolution();
  void fewerModesThanAskedFor();
  void looseAndUnstableModelsAreRefused();
  void canBeCancelled();
};

void TestLinearModes::chainAgreesWithClosedForm_data() {
  QTest::addColumn<int>("masses");
  QTest::addColumn<int>("count");
  QTest::newRow("dense") << 7 << 7;
  QTest::newRow("Lanczos") << 400 << 12;
}

void TestLinearModes::chainAgreesWithClosedForm() {
  QFETCH(int, masses);
  QFETCH(int, count);
  const double stiffness = 50, mass = 0.2;
  auto model = uniformChain(masses, stiffness, mass);
  model->massDamping = 0.4;
  model->stiffnessDamping = 3e-3;
  const LinearModes found = modesOf(model, count);
  QVERIFY2(found.report.converged(), found.report.message.c_str());
  QCOMPARE(static_cast<int>(found.modes.size()), count);
  for (int k = 1; k <= count; ++k) {
    const harmonic::LinearMode& mode = found.modes[static_cast<std::size_t>(k - 1)];
    const double omega = 2 * std::sqrt(stiffness / mass) * std::sin(k * pi / (2 * (masses + 1)));
    QVERIFY(std::abs(mode.omega - omega) <= 1e-9 * omega);
    QVERIFY(std::abs(mode.dampingRatio - 0.5 * (0.4 / omega + 3e-3 * omega)) <= 1e-8 * mode.dampingRatio);
    QVERIFY(mode.residual < 1e-8);
    Vector shape(masses);
    for (int i = 0; i < masses; ++i) shape[i] = std::sin((i + 1) * k * pi / (masses + 1));
    shape /= std::sqrt(mass) * shape.norm();
    const double sign = shape.dot(mode.shape) < 0 ? -1 : 1;
    QVERIFY((sign * shape - mode.shape).norm() <= 1e-6 * shape.norm());
  }
  const Matrix shapes = shapesOf(found);
  QVERIFY((mass * shapes.transpose() * shapes - Matrix::Identity(count, count)).norm() < 1e-8);
}

/// Two springs in a row through a node without mass are one of half the stiffness.
void TestLinearModes::masslessNodesFollowTheOthers() {
  auto model = points(1, Vector::LinSpaced(4, 1, 4));
  model->energies.push_back(mechanics::makeAnchoredSpring(1, 0, Vector::Zero(1), 1, {{40}}));
  for (int i = 0; i < 3; ++i) model->energies.push_back(mechanics::makeSpring(1, i, i + 1, 1, {{40}}));
  addPointMass(*model, "first", {1}, 0.5);
  addPointMass(*model, "second", {3}, 0.5);
  const LinearModes found = modesOf(model, 4);
  QVERIFY2(found.report.converged(), found.report.message.c_str());
  QCOMPARE(found.modes.size(), std::size_t(2));
  for (int i : {0, 1}) {  // the chain wall - 20 N/m - m - 20 N/m - m
    const double squared = 20 / 0.5 * (3 + (i == 0 ? -1 : 1) * std::sqrt(5)) / 2;
    QVERIFY(std::abs(found.modes[i].omega - std::sqrt(squared)) <= 1e-12 * std::sqrt(squared));
    QVERIFY(std::abs(found.modes[i].shape[2] - 0.5 * (found.modes[i].shape[1] + found.modes[i].shape[3])) < 1e-12);
  }
}

/// Sideways a mass on a stretched spring is a pendulum, along it an oscillator.
void TestLinearModes::weightTightensAPendulum() {
  const double stiffness = 30, mass = 0.4, gravity = 9.81, length = 0.5;
  auto model = points(3, vector3(0, 0, -length));
  model->energies = {mechanics::makeAnchoredSpring(3, 0, vector3(0, 0, 0), length, {{stiffness}})};
  model->gravity = vector3(0, 0, -gravity);
  addPointMass(*model, "bob", {0}, mass);
  const LinearModes found = modesOf(model, 3);
  QVERIFY2(found.report.converged(), found.report.message.c_str());
  const double stretched = length + mass * gravity / stiffness;
  QVERIFY((found.equilibrium - vector3(0, 0, -stretched)).norm() < 1e-9);
  const double sideways = std::sqrt(gravity / stretched), along = std::sqrt(stiffness / mass);
  QVERIFY(std::abs(found.modes[0].omega - sideways) < 1e-8 * sideways);
  QVERIFY(std::abs(found.modes[1].omega - sideways) < 1e-8 * sideways);
  QVERIFY(std::abs(found.modes[2].omega - along) < 1e-8 * along);
}

/// A thin foil, a million times stiffer in its plane than against bending, with consistent masses.
void TestLinearModes::shellAgreesWithADenseSolution() {
  const StripOptions options{40, 2, 1e8, 5e-4, mechanics::MassMatrix::consistent, 2e-4, true};
  const geometry::SurfaceMesh mesh = stripMesh(options);
  const auto model = strip(options, mesh);
  for (const int node : clampedNodes(mesh, 4e-3))
    for (int axis = 0; axis < 3; ++axis) model->lockedCoordinates[3 * node + axis] = 1;
  const int count = 10;
  const LinearModes found = modesOf(model, count);
  QVERIFY2(found.report.converged(), found.report.message.c_str());
  QCOMPARE(static_cast<int>(found.modes.size()), count);

  const auto& free = model->dofs.freeCoordinates;
  QVERIFY(free.size() > 300);
  const Matrix mass = Matrix(model->massMatrix())(free, free);
  const Matrix stiffness = Matrix(mechanics::ElasticAssembler(model).hessian(found.equilibrium));
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> dense(stiffness, mass);
  for (int i = 0; i < count; ++i) {
    const double omega = std::sqrt(dense.eigenvalues()[i]);
    const harmonic::LinearMode& mode = found.modes[static_cast<std::size_t>(i)];
    QVERIFY2(std::abs(mode.omega - omega) < 1e-6 * omega, qPrintable(QString("%1 %2").arg(mode.omega).arg(omega)));
    QVERIFY(mode.residual < 1e-6);
    QVERIFY(std::abs(std::abs(mode.shape.dot(mass * dense.eigenvectors().col(i))) - 1) < 1e-6);
  }
}

void TestLinearModes::fewerModesThanAskedFor() {
  const LinearModes found = modesOf(uniformChain(3, 1, 1), 50);
  QVERIFY(found.report.converged());
  QCOMPARE(found.modes.size(), std::size_t(3));
}

void TestLinearModes::looseAndUnstableModelsAreRefused() {
  auto loose = points(3, vector3(0, 0, -1));
  loose->energies = {mechanics::makeAnchoredSpring(3, 0, vector3(0, 0, 0), 1, {{10}})};
  addPointMass(*loose, "bob", {0}, 1);
  const LinearModes turning = modesOf(loose, 3);
  QVERIFY(turning.report.termination == base::TerminationType::failed);
  QVERIFY2(QString::fromStdString(turning.report.message).startsWith("Nothing holds node 0 along"),
           turning.report.message.c_str());
  QVERIFY(turning.modes.empty());

  auto unstable = points(1, Vector::Zero(1));
  unstable->energies = {mechanics::makeGroundedSpring(1, 0, Vector::Zero(1), Vector::Ones(1), {{-1, 0, 1}})};
  addPointMass(*unstable, "ball on a hill", {0}, 1);
  const LinearModes falling = modesOf(unstable, 1);
  QVERIFY(falling.report.termination == base::TerminationType::failed);
  QVERIFY2(QString::fromStdString(falling.report.message).contains("not stable"), falling.report.message.c_str());
}

void TestLinearModes::canBeCancelled() {
  auto model = uniformChain(400, 1, 1);
  model->finish();
  base::ExecutionContext context;
  context.requestCancel();
  const LinearModes found = harmonic::computeLinearModes(harmonic::HarmonicBalanceProblem(model, {1, 16}), {}, context);
  QVERIFY(found.report.termination == base::TerminationType::cancelled);
}

QTEST_GUILESS_MAIN(TestLinearModes)
#include "test_linear_modes.moc"
