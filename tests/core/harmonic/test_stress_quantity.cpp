#include <QTest>

#include "core/base/error.hpp"
#include "core/harmonic/design_gradient.hpp"
#include "core/harmonic/stress_quantity.hpp"
#include "core/mechanics/family_parameter.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;

namespace {

constexpr double omega = 18;
constexpr int cells = 4;

/// A strip of shell whose held start is shaken up and down.
Model shakenStrip(const std::vector<double>& values) {
  StripOptions options;
  options.lengthCells = cells;
  options.bump = 1e-4;
  options.thickness = values.at(0);
  options.youngModulus = values.at(1);
  geometry::SurfaceMesh mesh = stripMesh(options);
  mesh.points.row(0) *= values.at(2);
  Model model = *strip(options, mesh);
  model.drives = {mechanics::makeTranslation(
      clampedNodes(mesh, 1.1 * values.at(2) * 0.1 / cells), vector3(0, 0, 1), cosine(values.at(3)))};
  model.massDamping = 1;
  model.familyValues = values;
  model.probes = {{"end", static_cast<int>(mesh.points.cols()) - 1}};
  addPointMass(model, "end", {model.probes[0].node}, 1e-4);
  model.finish();
  return model;
}

const std::vector<double> middle = {5e-4, 1e8, 1, 2e-3};

std::shared_ptr<const Model> stripWithParameters() {
  auto model = std::make_shared<Model>(shakenStrip(middle));
  const auto family = std::make_shared<const mechanics::ModelFamily>(shakenStrip);
  for (int i = 0; i < static_cast<int>(middle.size()); ++i) {
    const double value = middle[static_cast<std::size_t>(i)];
    model->parameters.push_back(mechanics::makeFamilyParameter(
        i, {"value " + std::to_string(i), "/value", base::dimensions::none, value / 2, 2 * value}, family));
  }
  return model;
}

mechanics::Triangles trianglesOf() {
  StripOptions options;
  options.lengthCells = cells;
  return stripMesh(options).triangles;
}

PeriodicMotion solve(HarmonicBalanceProblem& problem, const Vector& start = {}) {
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions options;
  options.tolerance = options.stepTolerance = 1e-13;
  PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, options, context, start);
  if (!motion.report.converged()) qFatal("there is no motion");
  return motion;
}

}  // namespace

class TestStressQuantity : public QObject {
  Q_OBJECT

 private slots:
  void gradientAgreesWithDifferencesOfWholeSolves_data();
  void gradientAgreesWithDifferencesOfWholeSolves();
  void refusesModelsWithoutElements();
};

void TestStressQuantity::gradientAgreesWithDifferencesOfWholeSolves_data() {
  QTest::addColumn<int>("measure");
  QTest::addColumn<int>("parameter");
  const char* names[] = {"end mass", "thickness", "Young's modulus", "length", "drive"};
  for (const auto measure : {mechanics::ElementMeasure::vonMises, mechanics::ElementMeasure::principalStrain})
    for (int p = 0; p < 5; ++p)
      QTest::addRow("%s by %s", measure == mechanics::ElementMeasure::vonMises ? "stress" : "strain", names[p])
          << static_cast<int>(measure) << p;
}

/// Of a shell that bends, with the shape at rest among the parameters.
void TestStressQuantity::gradientAgreesWithDifferencesOfWholeSolves() {
  QFETCH(int, measure);
  QFETCH(int, parameter);
  const auto model = stripWithParameters();
  HarmonicBalanceProblem problem(model, {3, 16});
  const PeriodicMotion motion = solve(problem);
  const auto kind = static_cast<mechanics::ElementMeasure>(measure);
  // So that several elements and instants count.
  const double size = kind == mechanics::ElementMeasure::vonMises ? 1e8 * 1e-3 : 1e-3;
  const auto quantity = harmonic::makeLargestStress({trianglesOf(), {}, kind, 30 / size});
  const harmonic::DesignGradient gradient = harmonic::designGradient(problem, motion, *quantity, {parameter});
  const auto& changing = *model->parameters[static_cast<std::size_t>(parameter)];
  const auto valueAt = [&](double change) {
    HarmonicBalanceProblem changed(
        std::make_shared<const Model>(changing.withValue(*model, changing.value(*model) + change)), {3, 16});
    return quantity->evaluate(changed, solve(changed, motion.z).z).value;
  };
  QVERIFY(gradient.value > 0.1 * size);
  const double step = 1e-4 * changing.value(*model);
  const double difference =
      (8 * (valueAt(step) - valueAt(-step)) - (valueAt(2 * step) - valueAt(-2 * step))) / (12 * step);
  QVERIFY2(std::abs(gradient.gradient[0] - difference) < 1e-5 * std::abs(difference),
           qPrintable(QString("%1, differences %2").arg(gradient.gradient[0], 0, 'g', 10).arg(difference, 0, 'g', 10)));
}

void TestStressQuantity::refusesModelsWithoutElements() {
  HarmonicBalanceProblem problem(duffing(0.05, 0, 0.1), {1, 8});
  const auto quantity = harmonic::makeLargestStress({{{0, 1, 2}}, {}});
  try {
    quantity->evaluate(problem, Vector::Zero(problem.size()));
    QFAIL("nothing was refused");
  } catch (const base::InputError& error) {
    QVERIFY(!error.problem().empty());
  }
}

QTEST_GUILESS_MAIN(TestStressQuantity)
#include "test_stress_quantity.moc"
