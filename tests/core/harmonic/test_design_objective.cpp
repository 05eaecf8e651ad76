#include <QTest>

#include "core/harmonic/design_gradient.hpp"
#include "core/harmonic/path_length.hpp"
#include "core/mechanics/registry.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::DesignObjective;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;

namespace {

constexpr double omega = 3;

HarmonicBalanceProblem problemOf(Model model) {
  return {std::make_shared<const Model>(std::move(model)), math::HarmonicBasis(5, 32)};
}

PeriodicMotion solve(HarmonicBalanceProblem& problem, const Vector& start = {}) {
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions options;
  options.tolerance = 1e-13;  // as far as rounding lets it
  options.stepTolerance = 1e-13;
  PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, options, context, start);
  if (!motion.report.converged()) QTest::qFail("there is no motion", __FILE__, __LINE__);
  return motion;
}

/// Mean squared distance of two motions of some nodes, by sums over samples in time, the second begun earlier by
/// `shift` samples.
double meanSquare(const Matrix& a, const Matrix& b, Eigen::Index shift) {
  double sum = 0;
  for (Eigen::Index i = 0; i < a.rows(); ++i) sum += (a.row(i) - b.row((i + shift) % b.rows())).squaredNorm();
  return sum / static_cast<double>(a.rows());
}

}  // namespace

class TestDesignObjective : public QObject {
  Q_OBJECT

 private slots:
  void gradientAgreesWithDifferencesOfWholeSolves_data();
  void gradientAgreesWithDifferencesOfWholeSolves();
  void gradientNeedsNoFactorsLeftBehind();
  void axesLeaveTheOthersOut();
  void pathDistanceIsThatOfTrajectories();
  void phaseDoesNotCount();
  void nodesShareAPhase();
  void pathCoefficientsGoThroughThePoints();
  void sharpMinimumIsTheSmallestDistance();
};

void TestDesignObjective::gradientAgreesWithDifferencesOfWholeSolves_data() {
  QTest::addColumn<int>("objectiveKind");
  QTest::addColumn<int>("parameterKind");
  for (std::size_t o = 0; o < harmonic::objectiveKinds().size(); ++o)
    for (std::size_t p = 0; p < mechanics::parameterKinds().size(); ++p)
      QTest::addRow("%s by %s", harmonic::objectiveKinds()[o].name.c_str(), mechanics::parameterKinds()[p].name.c_str())
          << static_cast<int>(o) << static_cast<int>(p);
}

void TestDesignObjective::gradientAgreesWithDifferencesOfWholeSolves() {
  QFETCH(int, objectiveKind);
  QFETCH(int, parameterKind);
  for (unsigned seed = 0; seed < 3; ++seed) {
    std::mt19937 random(seed);
    const Model model = mechanics::parameterKinds()[static_cast<std::size_t>(parameterKind)].drivenExample(random);
    HarmonicBalanceProblem problem = problemOf(model);
    const auto objective = harmonic::objectiveKinds()[static_cast<std::size_t>(objectiveKind)].example(problem, random);
    const PeriodicMotion motion = solve(problem);
    const harmonic::DesignGradient gradient = harmonic::designGradient(problem, motion, *objective, {0});
    QVERIFY(gradient.regular);
    const auto valueAt = [&](double change) {
      const auto& parameter = *model.parameters[0];
      HarmonicBalanceProblem changed = problemOf(parameter.withValue(model, parameter.value(model) + change));
      return objective->evaluate(changed, solve(changed, motion.z).z).value;
    };
    QCOMPARE(gradient.value, valueAt(0));
    const double step = 1e-3;
    const double difference =
        (8 * (valueAt(step) - valueAt(-step)) - (valueAt(2 * step) - valueAt(-2 * step))) / (12 * step);
    const double error = std::abs(gradient.gradient[0] - difference) / std::abs(difference);
    QVERIFY2(error < 1e-6, qPrintable(QString("%1, differences %2: %3")
                                          .arg(gradient.gradient[0], 0, 'g', 10)
                                          .arg(difference, 0, 'g', 10)
                                          .arg(error)));
  }
}

void TestDesignObjective::gradientNeedsNoFactorsLeftBehind() {
  std::mt19937 random(4);
  HarmonicBalanceProblem problem = problemOf(mechanics::parameterKinds()[0].drivenExample(random));
  const auto objective = harmonic::makeAmplitudeObjective({{2}, {}, {}});
  PeriodicMotion motion = solve(problem);
  const int before = problem.cost().factorizations;
  const Vector reused = harmonic::designGradient(problem, motion, *objective, {0, 1}).gradient;
  QCOMPARE(problem.cost().factorizations, before);
  motion.factorization.reset();
  const Vector fresh = harmonic::designGradient(problem, motion, *objective, {0, 1}).gradient;
  QCOMPARE(problem.cost().factorizations, before + 1);
  QVERIFY((reused - fresh).norm() < 1e-9 * fresh.norm());
  QCOMPARE(harmonic::designGradient(problem, motion, *objective, {1}).gradient[0], fresh[1]);
}

/// Along x alone a node passes its path twice: to the right and back.
void TestDesignObjective::axesLeaveTheOthersOut() {
  std::mt19937 random(4);
  HarmonicBalanceProblem problem = problemOf(mechanics::parameterKinds()[0].drivenExample(random));
  Vector z = problem.restCoefficients();
  const Eigen::Index width = problem.basis().size();
  z[2 * width + 1] = 0.3;  // node 2: 0.3 sin τ along x, 0.2 cos 2τ along y
  z[3 * width + 4] = 0.2;
  const auto along = [&](std::vector<int> axes) {
    return harmonic::makeAmplitudeObjective({{2}, {}, std::move(axes)})->evaluate(problem, z).value;
  };
  QVERIFY(std::abs(along({0}) + 4 * 0.3) < 1e-9);
  QVERIFY(std::abs(along({1}) + 8 * 0.2) < 1e-9);
  QVERIFY(std::abs(along({0, 1}) - along({})) < 1e-12 && along({}) < along({1}));
}

void TestDesignObjective::pathDistanceIsThatOfTrajectories() {
  std::mt19937 random(5);
  HarmonicBalanceProblem problem = problemOf(mechanics::parameterKinds()[0].drivenExample(random));
  const PeriodicMotion motion = solve(problem);
  harmonic::PathGoal goal;
  goal.matchPlace = true;
  const Matrix target = 0.1 * Matrix::Random(problem.basis().size(), 2);
  goal.paths = {{1, target}};
  const harmonic::PathDistance distance = harmonic::pathDistance(problem, motion.z, goal);
  // Against sums over time, the best of many shifts.
  const math::HarmonicBasis fine(5, 4096);
  const Matrix path = fine.synthesis() * harmonic::nodeCoefficients(problem, motion.z, 1);
  const Matrix wanted = fine.synthesis() * target;
  double best = std::numeric_limits<double>::infinity();
  for (Eigen::Index shift = 0; shift < 4096; shift += 4) best = std::min(best, meanSquare(path, wanted, shift));
  QVERIFY(std::abs(distance.rootMeanSquare - std::sqrt(best)) < 1e-4 * std::sqrt(best));
  QVERIFY(distance.rootMeanSquare <= std::sqrt(best));
  QCOMPARE(distance.relativeOfPath.size(), std::size_t(1));
  QCOMPARE(distance.relativeOfPath[0], distance.relative);
}

void TestDesignObjective::phaseDoesNotCount() {
  std::mt19937 random(6);
  HarmonicBalanceProblem problem = problemOf(mechanics::parameterKinds()[0].drivenExample(random));
  const PeriodicMotion motion = solve(problem);
  // The node's own path, begun a quarter of a period later.
  const math::HarmonicBasis samples(5, 64);
  const Matrix path = samples.synthesis() * harmonic::nodeCoefficients(problem, motion.z, 2);
  Matrix later(2, 64);
  for (int i = 0; i < 64; ++i) later.col(i) = path.row((i + 48) % 64).transpose();
  harmonic::PathGoal goal;
  goal.paths = {{2, harmonic::pathCoefficients(later, 5)}};
  QVERIFY(harmonic::pathDistance(problem, motion.z, goal).relative < 1e-7);
  QVERIFY(std::abs(harmonic::pathDistance(problem, motion.z, goal).phase - std::numbers::pi / 2) < 1e-6);
  goal.phases = 64;
  const double swing = goal.paths[0].coefficients.bottomRows(10).squaredNorm();
  QVERIFY(harmonic::makePathObjective(goal)->evaluate(problem, motion.z).value < 1e-2 * swing);
  // Its place counts if asked for.
  goal.paths[0].coefficients.row(0).array() += 0.5;
  QVERIFY(harmonic::pathDistance(problem, motion.z, goal).relative < 1e-7);
  goal.matchPlace = true;
  QVERIFY(std::abs(harmonic::pathDistance(problem, motion.z, goal).rootMeanSquare - std::sqrt(0.5)) < 1e-6);
}

/// Two nodes whose targets are their own paths, one of them half a period late, cannot both be met.
void TestDesignObjective::nodesShareAPhase() {
  std::mt19937 random(6);
  HarmonicBalanceProblem problem = problemOf(mechanics::parameterKinds()[0].drivenExample(random));
  const PeriodicMotion motion = solve(problem);
  Matrix first = harmonic::nodeCoefficients(problem, motion.z, 1);
  const Matrix second = harmonic::nodeCoefficients(problem, motion.z, 2);
  harmonic::PathGoal goal;
  goal.paths = {{1, first}, {2, second}};
  QVERIFY(harmonic::pathDistance(problem, motion.z, goal).relative < 1e-7);
  for (int k = 1; k <= 5; k += 2) first.middleRows(2 * k - 1, 2) *= -1;
  goal.paths = {{1, first}};
  QVERIFY(harmonic::pathDistance(problem, motion.z, goal).relative < 1e-7);
  goal.paths = {{1, first}, {2, second}};
  QVERIFY(harmonic::pathDistance(problem, motion.z, goal).relative > 0.5);
}

void TestDesignObjective::pathCoefficientsGoThroughThePoints() {
  const Matrix points = Matrix::Random(3, 11);
  const Matrix coefficients = harmonic::pathCoefficients(points, 8);
  QCOMPARE(coefficients.rows(), Eigen::Index(17));
  const math::HarmonicBasis basis(8, 33);
  for (int i = 0; i < 11; ++i) {
    const Vector at = coefficients.transpose() * basis.valuesAt(2 * std::numbers::pi * i / 11);
    QVERIFY((at - points.col(i)).norm() < 1e-12);
  }
}

void TestDesignObjective::sharpMinimumIsTheSmallestDistance() {
  std::mt19937 random(8);
  HarmonicBalanceProblem problem = problemOf(mechanics::parameterKinds()[0].drivenExample(random));
  const PeriodicMotion motion = solve(problem);
  harmonic::PathGoal goal;
  goal.matchPlace = true;
  goal.paths = {{1, 0.2 * Matrix::Random(7, 2)}};
  goal.phases = 4096;
  double smallest = std::pow(harmonic::pathDistance(problem, motion.z, goal).rootMeanSquare, 2) * 2;
  double previous = std::numeric_limits<double>::infinity();
  for (const double sharpness : {1e1, 1e2, 1e4, 1e8}) {
    goal.sharpness = sharpness;
    const double value = harmonic::makePathObjective(goal)->evaluate(problem, motion.z).value;
    QVERIFY(value < previous && value >= smallest);
    previous = value;
  }
  QVERIFY(previous < (1 + 1e-4) * smallest);
}

QTEST_GUILESS_MAIN(TestDesignObjective)
#include "test_design_objective.moc"
