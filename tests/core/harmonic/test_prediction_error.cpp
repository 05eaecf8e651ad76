#include <QTest>

#include "core/harmonic/prediction_error.hpp"
#include "core/mechanics/joint_parameter.hpp"
#include "core/mechanics/registry.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::ParameterRange;
using harmonic::PeriodicMotion;
using harmonic::PredictionError;
using harmonic::ResponseSensitivity;

namespace {

/// A strip with two masses that swings far: its foot turns by 15 degrees, gravity pulls.
std::shared_ptr<const Model> weightedStrip() {
  const StripOptions options;
  const geometry::SurfaceMesh mesh = stripMesh(options);
  auto model = strip(options, mesh);
  const int last = static_cast<int>(mesh.points.cols()) - 1;
  addPointMass(*model, "tip", {last}, 4e-4);
  addPointMass(*model, "middle", {last / 2, last / 2 + 1}, 2e-4);
  model->gravity = vector3(0, 0, -9.81);
  model->massDamping = 1.5;
  model->stiffnessDamping = 1e-4;
  model->drives = {mechanics::makeRotation(
      clampedNodes(mesh, 0.02), vector3(0, 0, 0), Eigen::Vector3d::UnitY(), sine(15 * std::numbers::pi / 180))};
  model->finish();
  return model;
}

struct Example {
  std::string name;
  std::shared_ptr<const Model> model;
  math::HarmonicBasis basis;
  double omega;
  Vector direction;  ///< of the parameters, of any length
};

/// An oscillator on its hardening resonance, a shell with one mass and with two at once, and each kind of parameter.
std::vector<Example> examples() {
  std::vector<Example> list = {
      {"duffing", duffing(0.02, 0.5, 0.1), {9, 64}, 1.15, Vector::Ones(1)},
      {"strip, one mass", weightedStrip(), {4, 24}, 9, Eigen::Vector2d(1, 0)},
      {"strip, two masses", weightedStrip(), {4, 24}, 9, Eigen::Vector2d(4, -10)},
  };
  for (const mechanics::ParameterKind& kind : mechanics::parameterKinds()) {
    std::mt19937 random(3);
    auto model = std::make_shared<const Model>(kind.drivenExample(random));
    const Vector direction = Vector::Unit(static_cast<Eigen::Index>(model->parameters.size()), 0);
    list.push_back({kind.name, model, {5, 32}, 3, direction});
  }
  return list;
}

PeriodicMotion solve(const Example& example, std::shared_ptr<const Model> model, const Vector& start = {}) {
  HarmonicBalanceProblem problem(std::move(model), example.basis);
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions options;
  options.tolerance = 1e-13;  // as far as rounding lets it
  options.stepTolerance = 1e-12;
  PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, example.omega, options, context, start);
  if (!motion.report.converged()) QTest::qFail("there is no motion", __FILE__, __LINE__);
  return motion;
}

Vector valuesOf(const Model& model) {
  Vector values(static_cast<Eigen::Index>(model.parameters.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = model.parameters[static_cast<std::size_t>(i)]->value(model);
  return values;
}

/// The motion of a whole solve.
Vector motionAt(const Example& example, const Vector& change, const Vector& start) {
  const Model& model = *example.model;
  return solve(example,
               std::make_shared<const Model>(
                   mechanics::withParameterValues(model, model.parameters, valuesOf(model) + change)),
               start)
      .z;
}

}  // namespace

class TestPredictionError : public QObject {
  Q_OBJECT

 private slots:
  void errorsOfPredictionsAreForetold_data() { rows(); }
  void errorsOfPredictionsAreForetold();
  void rangesHoldTheErrorBelowTheShare_data() { rows(); }
  void rangesHoldTheErrorBelowTheShare();
  void boundsOfAParameterBoundItsRange();
  void needsNoFactorsLeftBehind();
  void worksAtTheEndOfWhatAParameterAllows();

 private:
  static void rows() {
    QTest::addColumn<int>("index");
    const auto list = examples();
    for (std::size_t i = 0; i < list.size(); ++i) QTest::newRow(list[i].name.c_str()) << static_cast<int>(i);
  }
};

/// Against whole solves: error over estimate tends to 1, and the error of order n falls with the power n + 1 of the
/// change.
void TestPredictionError::errorsOfPredictionsAreForetold() {
  QFETCH(int, index);
  const Example example = examples()[static_cast<std::size_t>(index)];
  const PeriodicMotion motion = solve(example, example.model);
  const HarmonicBalanceProblem problem(example.model, example.basis);
  const ResponseSensitivity sensitivity(problem, motion);
  const PredictionError prediction(problem, motion, sensitivity);
  QVERIFY(prediction.regular());
  const double swing = problem.oscillation(motion.z).norm();
  QVERIFY(prediction.predict(example.direction, 1) == sensitivity.predict(example.direction));
  const double thousandth = 0.001 * swing / (sensitivity.derivative() * example.direction).norm();
  constexpr double roundingOfFamilies = 1e-8;  // their dz/dp is a difference
  double deviation = 0;
  std::array<double, 3> errors{};
  for (const double multiple : {16, 8, 4}) {
    const Vector change = multiple * thousandth * example.direction;
    const Vector exact = motionAt(example, change, motion.z);
    std::array<double, 3> slopes{};
    for (int order = 1; order <= 3; ++order) {
      double& error = errors[static_cast<std::size_t>(order - 1)];
      const double before = std::exchange(error, (prediction.predict(change, order) - exact).norm() / swing);
      slopes[static_cast<std::size_t>(order - 1)] = before > 0 ? std::log2(before / error) : 0;
    }
    const double ratio = errors[0] / prediction.estimate(change);
    const double deviationBefore = std::exchange(deviation, std::abs(ratio - 1));
    qInfo("errors %.3e %.3e %.3e, over estimate %.5f; slopes %.3f, %.3f, %.3f", errors[0], errors[1], errors[2], ratio,
          slopes[0], slopes[1], slopes[2]);
    if (slopes[0] == 0) continue;
    for (std::size_t i = 0; i < slopes.size(); ++i)
      QVERIFY(std::abs(slopes[i] - static_cast<double>(i + 2)) < 0.25 || errors[i] < roundingOfFamilies);
    QVERIFY(deviation < 0.7 * deviationBefore);
  }
  QVERIFY(deviation < 0.1);
}

void TestPredictionError::rangesHoldTheErrorBelowTheShare() {
  QFETCH(int, index);
  const Example example = examples()[static_cast<std::size_t>(index)];
  const PeriodicMotion motion = solve(example, example.model);
  const HarmonicBalanceProblem problem(example.model, example.basis);
  const ResponseSensitivity sensitivity(problem, motion);
  const PredictionError prediction(problem, motion, sensitivity);
  const auto& parameter = *example.model->parameters[0];
  const double value = parameter.value(*example.model);
  for (const double share : {0.05, 0.01, 1e-4}) {
    const ParameterRange range = prediction.trustedRange(0, share);
    QVERIFY(range.lower < value && value < range.upper);
    for (const double end : {range.lower, range.upper}) {
      const Vector change = (end - value) * Vector::Unit(example.direction.size(), 0);
      const Vector error = sensitivity.predict(change) - motionAt(example, change, motion.z);
      const double relative = error.norm() / problem.oscillation(motion.z).norm();
      qInfo("%.4g of %.4g: error %.3g of %.3g", end, value, relative, share);
      QVERIFY(relative < 1.1 * share);
      const bool free = end != parameter.minimum(*example.model) && end != parameter.maximum(*example.model);
      if (free) QVERIFY(relative > 0.2 * share);
    }
  }
  // All parameters together, both ways.
  constexpr double share = 1e-3;
  for (const double sign : {-1.0, 1.0}) {
    const double reach = prediction.trustedReach(sign * example.direction, share);
    const Vector change = sign * reach * example.direction;
    const Vector error = sensitivity.predict(change) - motionAt(example, change, motion.z);
    const double relative = error.norm() / problem.oscillation(motion.z).norm();
    qInfo("%.4g of the direction: error %.3g of %.3g", sign * reach, relative, share);
    QVERIFY(relative < 1.1 * share && relative > 0.2 * share);
    QVERIFY(std::abs(prediction.trustedReach(2 * sign * example.direction, share) / reach - 0.5) < 1e-3);
  }
}

void TestPredictionError::boundsOfAParameterBoundItsRange() {
  Example example = examples()[0];
  auto model = std::make_shared<Model>(*example.model);
  model->pointMasses[0].minimum = 0.995;
  model->pointMasses[0].maximum = 1.002;
  example.model = model;
  const PeriodicMotion motion = solve(example, example.model);
  const HarmonicBalanceProblem problem(example.model, example.basis);
  const PredictionError prediction(problem, motion, ResponseSensitivity(problem, motion));
  QCOMPARE(prediction.trustedRange(0, 0.05).lower, 0.995);
  QCOMPARE(prediction.trustedRange(0, 0.05).upper, 1.002);
  QVERIFY(prediction.trustedRange(0, 1e-5).lower > 0.995 && prediction.trustedRange(0, 1e-5).upper < 1.002);
}

void TestPredictionError::needsNoFactorsLeftBehind() {
  const Example example = examples()[1];
  PeriodicMotion motion = solve(example, example.model);
  const HarmonicBalanceProblem problem(example.model, example.basis);
  const ResponseSensitivity sensitivity(problem, motion);
  const Vector reused = PredictionError(problem, motion, sensitivity).derivatives(example.direction, 2).second;
  motion.factorization.reset();
  const Vector fresh = PredictionError(problem, motion, sensitivity).derivatives(example.direction, 2).second;
  QVERIFY((reused - fresh).norm() < 1e-9 * fresh.norm());
}

/// A mass of 0 has motions on one side alone.
void TestPredictionError::worksAtTheEndOfWhatAParameterAllows() {
  Example example = examples()[2];
  auto model = std::make_shared<Model>(*example.model);
  model->pointMasses[1].mass = 0;
  example.model = model;
  const PeriodicMotion motion = solve(example, example.model);
  const HarmonicBalanceProblem problem(example.model, example.basis);
  const ResponseSensitivity sensitivity(problem, motion);
  const PredictionError prediction(problem, motion, sensitivity);
  const Vector change(Eigen::Vector2d(0, 1e-5));
  const double error = (sensitivity.predict(change) - motionAt(example, change, motion.z)).norm();
  const double ratio = error / problem.oscillation(motion.z).norm() / prediction.estimate(change);
  QVERIFY2(std::abs(ratio - 1) < 0.05, qPrintable(QString::number(ratio)));
}

QTEST_GUILESS_MAIN(TestPredictionError)
#include "test_prediction_error.moc"
