#include <QTest>

#include "core/harmonic/amplitude.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;

namespace {

/// Everything at once: membranes, hinges, springs, point masses, gravity, forces, a rotating and a shifting drive,
/// locks. `second`: some of the drives have the second frequency.
std::shared_ptr<const Model> everything(mechanics::MassMatrix mass, bool second = false) {
  const StripOptions options{4, 2, 1e5, 2e-3, mass, 2e-3, true};
  const geometry::SurfaceMesh mesh = stripMesh(options);
  auto model = strip(options, mesh);
  const int last = static_cast<int>(mesh.points.cols()) - 1;
  addPointMass(*model, "tip", {last}, 2e-3);
  addPointMass(*model, "pair", {last - 3, last - 4}, 1e-3);
  addPointMass(*model, "on the drive", {0, last - 6}, 3e-3);
  model->gravity = vector3(0.3, -0.2, -9.81);
  model->massDamping = 0.7;
  model->stiffnessDamping = 3e-3;
  model->energies.push_back(mechanics::makeAnchoredSpring(3, last, vector3(0.1, 0.05, 0.08), 0.05, {{20, 30, 4000}}));
  model->energies.push_back(mechanics::makeSpring(3, last, last - 5, 0.02, {{5, 10}}));
  model->drives = {mechanics::makeRotation({0, 1}, vector3(0, 0, 0), Eigen::Vector3d(0.1, 1, 0.2),
                                           {{{1, 0.6, -1.0}, {2, 0.1, 0.3, second}}}),
                   mechanics::makeTranslation({2}, vector3(0.1, 0.2, 1), {{{0, 1e-3, 0}, {1, 5e-3, 0.4}}})};
  model->forces = {
      {"force", {last}, vector3(0, 0.3, 1), {{{1, 2e-2, 0.2}, {3, 1e-2, 0.5}, {1, 1e-2, 0.4, second}, {0, 5e-3, 0}}}}};
  model->lockedCoordinates[3 * (last - 2) + 1] = 1;
  model->probes = {{"tip", last}};
  model->finish();
  return model;
}

Vector randomMotion(const HarmonicBalanceProblem& problem) {
  return problem.restCoefficients() + 3e-3 * randomVector(problem.size(), 3);
}

double relativeDifference(const Matrix& a, const Matrix& b) { return (a - b).norm() / b.norm(); }

}  // namespace

class TestHarmonicBalanceProblem : public QObject {
  Q_OBJECT

 private slots:
  void derivatives_data();
  void derivatives();
  void matrixPatternIsKept();
  void driveFraction();
  void pathLengthGradient();
  void pathLengthOfRestingNodeHasNoGradient();
  void changingHarmonics();
  void sampledAndContinuousPositionsAgree();
  void copiesAreIndependent();
};

void TestHarmonicBalanceProblem::derivatives_data() {
  QTest::addColumn<int>("mass");
  QTest::addColumn<int>("harmonics");
  QTest::addColumn<int>("samples");
  QTest::addColumn<bool>("mixed");
  QTest::addColumn<double>("ratio");
  QTest::newRow("lumped") << static_cast<int>(mechanics::MassMatrix::lumped) << 3 << 16 << false << 0.0;
  QTest::newRow("consistent") << static_cast<int>(mechanics::MassMatrix::consistent) << 2 << 12 << false << 0.0;
  QTest::newRow("fewest samples") << static_cast<int>(mechanics::MassMatrix::consistent) << 3 << 7 << false << 0.0;
  QTest::newRow("constant") << static_cast<int>(mechanics::MassMatrix::lumped) << 0 << 3 << false << 0.0;
  QTest::newRow("harmonics per coordinate")
      << static_cast<int>(mechanics::MassMatrix::consistent) << 3 << 16 << true << 0.0;
  QTest::newRow("two frequencies") << static_cast<int>(mechanics::MassMatrix::consistent) << 2 << 9 << false
                                   << std::numbers::sqrt2;
  QTest::newRow("two frequencies, fewest samples")
      << static_cast<int>(mechanics::MassMatrix::lumped) << 2 << 5 << false << 0.3;
}

void TestHarmonicBalanceProblem::derivatives() {
  QFETCH(int, mass);
  QFETCH(int, harmonics);
  QFETCH(int, samples);
  QFETCH(bool, mixed);
  QFETCH(double, ratio);
  const auto model = everything(static_cast<mechanics::MassMatrix>(mass), ratio > 0);
  const math::HarmonicBasis basis = ratio > 0 ? math::HarmonicBasis::ofTwoFrequencies(harmonics, samples, ratio)
                                              : math::HarmonicBasis(harmonics, samples);
  std::vector<int> coordinateHarmonics;
  for (int f = 0; mixed && f < model->dofs.freeCount(); ++f) coordinateHarmonics.push_back(f * 7 % (harmonics + 1));
  const HarmonicBalanceProblem problem(model, basis, 1, coordinateHarmonics);
  const Vector z = randomMotion(problem);
  const double omega = 7;

  Vector h, frequencyDerivative;
  SparseMatrix jacobian;
  problem.linearize(z, omega, h, &jacobian, &frequencyDerivative);
  QVERIFY(relativeDifference(problem.residual(z, omega), h) < 1e-14);

  const double step = 1e-7;
  Matrix differences(problem.size(), problem.size());
  for (Eigen::Index i = 0; i < problem.size(); ++i) {
    Vector forward = z, backward = z;
    forward[i] += step;
    backward[i] -= step;
    differences.col(i) = (problem.residual(forward, omega) - problem.residual(backward, omega)) / (2 * step);
  }
  const Matrix ofUnknowns = problem.restricted(problem.restricted(differences).transpose()).transpose();
  QCOMPARE(jacobian.rows(), problem.unknownCount());
  QVERIFY2(relativeDifference(jacobian, ofUnknowns) < 1e-7,
           qPrintable(QString::number(relativeDifference(jacobian, ofUnknowns))));
  QVERIFY(mixed == (problem.unknownCount() < problem.size()));
  QCOMPARE(problem.withoutLeftOut(h), h);

  const double frequencyStep = 1e-4;
  const Vector frequencyDifference =
      (problem.residual(z, omega + frequencyStep) - problem.residual(z, omega - frequencyStep)) / (2 * frequencyStep);
  if (harmonics > 0)
    QVERIFY(relativeDifference(frequencyDerivative, frequencyDifference) < 1e-8);
  else
    QVERIFY(frequencyDerivative.isZero(0));

  for (const auto& parameter : model->parameters) {
    const double value = parameter->value(*model);
    const double change = 0.1 * value;  // h is linear in a mass
    const auto changed = [&](double by) {
      return HarmonicBalanceProblem(
                 std::make_shared<Model>(parameter->withValue(*model, value + by)), basis, 1, coordinateHarmonics)
          .residual(z, omega);
    };
    const Vector difference = (changed(change) - changed(-change)) / (2 * change);
    QVERIFY(relativeDifference(problem.parameterDerivative(z, omega, *parameter), difference) < 1e-9);
  }
}

void TestHarmonicBalanceProblem::matrixPatternIsKept() {
  const HarmonicBalanceProblem problem(everything(mechanics::MassMatrix::consistent), {2, 10});
  const Vector z = randomMotion(problem);
  Vector h;
  SparseMatrix first, reused;
  problem.linearize(problem.restCoefficients(), 3, h, &reused, nullptr);
  const double* values = reused.valuePtr();
  problem.linearize(z, 5, h, &reused, nullptr);
  problem.linearize(z, 5, h, &first, nullptr);
  QCOMPARE(reused.valuePtr(), values);
  QCOMPARE((reused - first).norm(), 0.0);
  QVERIFY(reused.isCompressed());
}

void TestHarmonicBalanceProblem::driveFraction() {
  const auto model = everything(mechanics::MassMatrix::consistent);
  HarmonicBalanceProblem problem(model, {2, 12});
  const Matrix full = problem.trajectories(problem.restCoefficients());
  problem.setDriveFraction(0);
  const Matrix none = problem.trajectories(problem.restCoefficients());
  QVERIFY((none.rowwise() - none.row(0)).norm() == 0);
  QVERIFY((none.row(0).transpose() - problem.steadyConfiguration()).norm() == 0);
  // The motion about the steady place is scaled; what turns as a whole stays whole, and turns by less.
  problem.setDriveFraction(0.25);
  const Matrix quarter = problem.trajectories(problem.restCoefficients());
  const Eigen::Index shifted = 3 * 2, turned = 0;
  const auto swing = [&](const Matrix& motion, Eigen::Index column) -> Matrix {
    return (motion - none).middleCols(column, 3);
  };
  QVERIFY(swing(full, shifted).norm() > 1e-3);
  QVERIFY((swing(quarter, shifted) - 0.25 * swing(full, shifted)).norm() < 1e-15);
  QVERIFY(swing(quarter, turned).norm() < 0.5 * swing(full, turned).norm());
  const Vector center = vector3(0, 0, 0), rest = model->restPositions;
  for (Eigen::Index i = 0; i < quarter.rows(); ++i) {
    const Vector first = quarter.row(i).segment(0, 3).transpose(), second = quarter.row(i).segment(3, 3).transpose();
    QVERIFY(std::abs((first - second).norm() - (rest.segment(0, 3) - rest.segment(3, 3)).norm()) < 1e-15);
    QVERIFY(std::abs((second - center).norm() - (rest.segment(3, 3) - center).norm()) < 1e-15);
  }
  QVERIFY((problem.configurationAt(problem.restCoefficients(), 0) - quarter.row(0).transpose()).norm() < 1e-15);
  // Of the loads, gravity and the mean of the forces stay.
  problem.setDriveFraction(0);
  Vector expected = Vector::Zero(model->coordinateCount());
  for (int i = 0; i < 12; ++i) expected += model->externalForce(2 * std::numbers::pi * i / 12) / 12;
  QVERIFY((problem.steadyForce() - expected).norm() < 1e-15);
}

void TestHarmonicBalanceProblem::pathLengthGradient() {
  const HarmonicBalanceProblem problem(everything(mechanics::MassMatrix::lumped), {3, 16});
  const Vector z = randomMotion(problem);
  const int node = problem.model().probes[0].node;
  const Vector gradient = harmonic::pathLengthGradient(problem, z, node);
  const double step = 1e-7;
  Vector difference(problem.size());
  for (Eigen::Index i = 0; i < problem.size(); ++i) {
    Vector forward = z, backward = z;
    forward[i] += step;
    backward[i] -= step;
    difference[i] = (harmonic::amplitude(problem, forward, node).pathLength -
                     harmonic::amplitude(problem, backward, node).pathLength) /
                    (2 * step);
  }
  QVERIFY(relativeDifference(gradient, difference) < 1e-7);
}

void TestHarmonicBalanceProblem::pathLengthOfRestingNodeHasNoGradient() {
  const HarmonicBalanceProblem problem(everything(mechanics::MassMatrix::lumped), {3, 16});
  const int node = problem.model().probes[0].node;
  QVERIFY(harmonic::pathLengthGradient(problem, problem.restCoefficients(), node).isZero(0));
  QCOMPARE(harmonic::amplitude(problem, problem.restCoefficients(), node).pathLength, 0.0);
}

void TestHarmonicBalanceProblem::changingHarmonics() {
  const HarmonicBalanceProblem coarse(everything(mechanics::MassMatrix::lumped), {2, 24});
  const HarmonicBalanceProblem fine(coarse.sharedModel(), {5, 24});
  const Vector z = randomMotion(coarse);
  const Vector more = HarmonicBalanceProblem::changeHarmonics(z, 2, 5);
  QCOMPARE(more.size(), fine.size());
  QVERIFY((fine.trajectories(more) - coarse.trajectories(z)).norm() < 1e-14);
  QVERIFY(HarmonicBalanceProblem::changeHarmonics(more, 5, 2) == z);
}

void TestHarmonicBalanceProblem::sampledAndContinuousPositionsAgree() {
  const HarmonicBalanceProblem problem(everything(mechanics::MassMatrix::lumped), {3, 16});
  const Vector z = randomMotion(problem);
  const Matrix samples = problem.trajectories(z);
  for (int i = 0; i < 16; ++i)
    QVERIFY((problem.configurationAt(z, 2 * std::numbers::pi * i / 16) - samples.row(i).transpose()).norm() < 1e-14);
  for (int node = 0; node < problem.model().nodeCount(); ++node)
    QVERIFY((problem.nodeTrajectory(z, node) - samples.middleCols(3 * node, 3)).norm() < 1e-15);
}

void TestHarmonicBalanceProblem::copiesAreIndependent() {
  HarmonicBalanceProblem problem(everything(mechanics::MassMatrix::lumped), {2, 12});
  const Vector z = randomMotion(problem);
  const Vector h = problem.residual(z, 4);
  HarmonicBalanceProblem copy = problem;
  copy.setDriveFraction(0);
  QVERIFY(relativeDifference(copy.residual(z, 4), h) > 1e-3);
  QVERIFY(problem.residual(z, 4) == h);
}

QTEST_GUILESS_MAIN(TestHarmonicBalanceProblem)
#include "test_harmonic_balance_problem.moc"
