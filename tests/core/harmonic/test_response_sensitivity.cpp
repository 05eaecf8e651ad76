#include <QTest>

#include "core/harmonic/response_sensitivity.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;
using harmonic::ResponseSensitivity;

namespace {

/// A strip with two masses that swings far: its foot turns by 15 degrees, gravity pulls.
std::shared_ptr<const Model> swingingStrip() {
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
  model->probes = {{"tip", last}};
  model->finish();
  return model;
}

struct Example {
  std::string name;
  std::shared_ptr<const Model> model;
  math::HarmonicBasis basis;
  double omega;
  double step;  ///< of a parameter, relative to its value, by which the motion changes by about a hundredth
};
std::vector<Example> examples() {
  return {{"duffing", duffing(0.02, 0.5, 0.1), {9, 64}, 1.15, 2e-4}, {"strip", swingingStrip(), {4, 24}, 9, 2e-3}};
}

PeriodicMotion solve(const Example& example, std::shared_ptr<const Model> model, const Vector& start) {
  HarmonicBalanceProblem problem(std::move(model), example.basis);
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions options;
  options.tolerance = 1e-13;  // as far as rounding lets it
  options.stepTolerance = 1e-12;
  return harmonic::solvePeriodicMotion(problem, example.omega, options, context, start);
}

PeriodicMotion solveChanged(const Example& example, std::size_t parameter, double change, const Vector& start) {
  const auto& p = *example.model->parameters[parameter];
  auto changed = std::make_shared<Model>(p.withValue(*example.model, p.value(*example.model) + change));
  return solve(example, changed, start);
}

}  // namespace

class TestResponseSensitivity : public QObject {
  Q_OBJECT

 private slots:
  void agreesWithDifferencesOfWholeSolves_data() { rows(); }
  void agreesWithDifferencesOfWholeSolves();
  void predictionErrorIsQuadratic_data() { rows(); }
  void predictionErrorIsQuadratic();
  void doesNotDependOnTheFactorsLeftBehind_data() { rows(); }
  void doesNotDependOnTheFactorsLeftBehind();

 private:
  static void rows() {
    QTest::addColumn<int>("index");
    const auto list = examples();
    for (std::size_t i = 0; i < list.size(); ++i) QTest::newRow(list[i].name.c_str()) << static_cast<int>(i);
  }
};

void TestResponseSensitivity::agreesWithDifferencesOfWholeSolves() {
  QFETCH(int, index);
  const Example example = examples()[index];
  const PeriodicMotion motion = solve(example, example.model, {});
  QVERIFY(motion.report.converged());
  const ResponseSensitivity sensitivity(HarmonicBalanceProblem(example.model, example.basis), motion);
  QVERIFY(sensitivity.regular());
  for (std::size_t p = 0; p < example.model->parameters.size(); ++p) {
    const double step = example.step * example.model->parameters[p]->value(*example.model);
    const auto at = [&](double change) {
      const PeriodicMotion changed = solveChanged(example, p, change, motion.z);
      if (!changed.report.converged()) QTest::qFail("a changed design has no motion", __FILE__, __LINE__);
      return changed.z;
    };
    const Vector difference = (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
    const double error =
        (sensitivity.derivative().col(static_cast<Eigen::Index>(p)) - difference).norm() / difference.norm();
    QVERIFY2(error < 1e-6, qPrintable(QString("parameter %1: %2").arg(p).arg(error)));
  }
}

void TestResponseSensitivity::predictionErrorIsQuadratic() {
  QFETCH(int, index);
  const Example example = examples()[index];
  const PeriodicMotion motion = solve(example, example.model, {});
  const ResponseSensitivity sensitivity(HarmonicBalanceProblem(example.model, example.basis), motion);
  QVERIFY(sensitivity.predict(Vector::Zero(sensitivity.derivative().cols())) == motion.z);
  double previous = 0;
  for (const double multiple : {4, 2, 1}) {
    const double change = multiple * example.step * example.model->parameters[0]->value(*example.model);
    Vector changes = Vector::Zero(sensitivity.derivative().cols());
    changes[0] = change;
    const double error = (sensitivity.predict(changes) - solveChanged(example, 0, change, motion.z).z).norm();
    if (previous > 0) {
      const double slope = std::log2(previous / error);
      qInfo("slope %.3f", slope);
      QVERIFY2(std::abs(slope - 2) < 0.2, qPrintable(QString::number(slope)));
    }
    previous = error;
  }
}

void TestResponseSensitivity::doesNotDependOnTheFactorsLeftBehind() {
  QFETCH(int, index);
  const Example example = examples()[index];
  const HarmonicBalanceProblem problem(example.model, example.basis);
  PeriodicMotion motion = solve(example, example.model, {});
  QVERIFY(motion.factorization != nullptr);
  const ResponseSensitivity reused(problem, motion);
  motion.factorization.reset();
  const ResponseSensitivity fresh(problem, motion);
  QVERIFY((reused.derivative() - fresh.derivative()).norm() < 1e-9 * fresh.derivative().norm());
}

QTEST_GUILESS_MAIN(TestResponseSensitivity)
#include "test_response_sensitivity.moc"
