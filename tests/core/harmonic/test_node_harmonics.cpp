#include <QTest>

#include "core/harmonic/amplitude.hpp"
#include "core/harmonic/floquet_stability.hpp"
#include "core/harmonic/node_harmonics.hpp"
#include "core/harmonic/response_sensitivity.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using base::TerminationType;
using harmonic::HarmonicBalanceProblem;
using harmonic::NodeHarmonicsMotion;
using harmonic::PeriodicMotion;

namespace {

constexpr int nodes = 8;
constexpr double omega = 0.9;

/// Masses in a row. The first is driven and held by a strongly hardening spring; the others are linear, and hang on it
/// by weak springs.
std::shared_ptr<const Model> chain() {
  auto model = std::make_shared<Model>();
  model->dimension = 2;
  model->restPositions = Vector::Zero(2 * nodes);
  model->gravity = vector2(0, 0);
  for (int i = 0; i < nodes; ++i) {
    model->restPositions[2 * i] = 10.0 * i;
    model->lockedCoordinates.insert(model->lockedCoordinates.end(), {0, 1});
    const Vector place = model->restPositions.segment(2 * i, 2);
    model->energies.push_back(
        mechanics::makeGroundedSpring(2, i, place, vector2(1, 0), {{1.0, 0, i == 0 ? 0.5 : 0.0}}));
    if (i > 0) model->energies.push_back(mechanics::makeSpring(2, i - 1, i, 10, {{0.05}}));
    addPointMass(*model, "mass " + std::to_string(i), {i}, 1 + 0.1 * i);
  }
  model->massDamping = 0.1;
  model->forces = {{"force", {0}, vector2(1, 0), cosine(0.5)}};
  model->probes = {{"first", 0}, {"last", nodes - 1}};
  model->finish();
  return model;
}

NodeHarmonicsMotion solvePerNode(double relativeChange, int most) {
  base::ExecutionContext context;
  return harmonic::solveWithHarmonicsPerNode(
      HarmonicBalanceProblem(chain(), {1, 8}), omega, relativeChange, most, {}, context);
}

/// With many harmonics everywhere.
std::pair<HarmonicBalanceProblem, Vector> finest(const NodeHarmonicsMotion& found) {
  base::ExecutionContext context;
  HarmonicBalanceProblem problem(chain(), {31, 256});
  const Vector start = HarmonicBalanceProblem::changeHarmonics(found.motion.z, found.problem.basis().harmonics(), 31);
  PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, {}, context, start);
  return {problem, motion.z};
}

/// Largest distance of any node at any time.
double difference(const HarmonicBalanceProblem& a, const Vector& x, const HarmonicBalanceProblem& b, const Vector& y) {
  double largest = 0;
  for (int i = 0; i < 200; ++i) {
    const double tau = 2 * std::numbers::pi * i / 200;
    const Vector distance = a.configurationAt(x, tau) - b.configurationAt(y, tau);
    largest = std::max(largest, distance.cwiseAbs().maxCoeff());
  }
  return largest;
}

}  // namespace

class TestNodeHarmonics : public QObject {
  Q_OBJECT

 private slots:
  void eachNodeGetsWhatItNeeds_data();
  void eachNodeGetsWhatItNeeds();
  void mayNotSuffice();
  void sensitivityAgreesWithDifferences();
  void stabilityAgreesWithAllHarmonics();
};

void TestNodeHarmonics::eachNodeGetsWhatItNeeds_data() {
  QTest::addColumn<double>("relativeChange");
  for (const double relativeChange : {1e-3, 1e-4, 1e-6})
    QTest::newRow(qPrintable(QString::number(relativeChange))) << relativeChange;
}

void TestNodeHarmonics::eachNodeGetsWhatItNeeds() {
  QFETCH(double, relativeChange);
  const NodeHarmonicsMotion found = solvePerNode(relativeChange, 31);
  QVERIFY2(found.motion.report.converged(), found.motion.report.message.c_str());
  QVERIFY(found.leftOut <= relativeChange);
  const auto [fine, z] = finest(found);
  const double error = difference(found.problem, found.motion.z, fine, z) / harmonic::amplitude(fine, z, 0).pathLength;
  QVERIFY2(error <= relativeChange, qPrintable(QString::number(error)));
  // It is an estimate of that error, not a bound far above it.
  QVERIFY2(found.leftOut > 0.1 * error && found.leftOut < 10 * error,
           qPrintable(QStringLiteral("%1 for %2").arg(found.leftOut).arg(error)));
  const auto& harmonics = found.problem.coordinateHarmonics();
  QCOMPARE(harmonics.front(), found.problem.basis().harmonics());
  QVERIFY(harmonics.back() < harmonics.front());
  QVERIFY(found.problem.unknownCount() < found.problem.size());
  QCOMPARE(found.problem.withoutLeftOut(found.motion.z), found.motion.z);
}

void TestNodeHarmonics::mayNotSuffice() {
  const NodeHarmonicsMotion found = solvePerNode(1e-9, 5);
  QVERIFY(found.motion.report.termination == TerminationType::iterationLimit);
  QCOMPARE(found.problem.basis().harmonics(), 5);
  QVERIFY(found.leftOut > 1e-9);
  QCOMPARE(found.motion.z.size(), found.problem.size());
}

void TestNodeHarmonics::sensitivityAgreesWithDifferences() {
  const NodeHarmonicsMotion found = solvePerNode(1e-3, 31);
  const auto model = found.problem.sharedModel();
  const harmonic::ResponseSensitivity sensitivity(found.problem, found.motion);
  QVERIFY(sensitivity.regular());
  for (std::size_t p = 0; p < model->parameters.size(); ++p) {
    const double value = model->parameters[p]->value(*model);
    const auto solved = [&](double change) {
      base::ExecutionContext context;
      HarmonicBalanceProblem problem(std::make_shared<Model>(model->parameters[p]->withValue(*model, value + change)),
                                     found.problem.basis(), 1, found.problem.coordinateHarmonics());
      return harmonic::solvePeriodicMotion(problem, omega, {1e-13}, context, found.motion.z).z;
    };
    const double step = 1e-3;
    // Richardson's extrapolation: what is left of the differences' own error is of the fourth order.
    const Vector difference =
        (8 * (solved(step) - solved(-step)) - (solved(2 * step) - solved(-2 * step))) / (12 * step);
    const Vector column = sensitivity.derivative().col(static_cast<Eigen::Index>(p));
    const double error = (column - difference).norm() / difference.norm();
    QVERIFY2(error < 1e-6, qPrintable(QStringLiteral("parameter %1: %2").arg(p).arg(error)));
  }
}

void TestNodeHarmonics::stabilityAgreesWithAllHarmonics() {
  const NodeHarmonicsMotion found = solvePerNode(1e-6, 31);
  const auto [fine, z] = finest(found);
  const auto rough = harmonic::floquetStability(found.problem, found.motion.z, omega);
  const auto exact = harmonic::floquetStability(fine, z, omega);
  QVERIFY(exact.state == harmonic::StabilityState::stable);
  QVERIFY(rough.state == exact.state);
  QVERIFY(std::abs(std::abs(rough.multipliers.front()) - std::abs(exact.multipliers.front())) < 1e-4);
}

QTEST_GUILESS_MAIN(TestNodeHarmonics)
#include "test_node_harmonics.moc"
