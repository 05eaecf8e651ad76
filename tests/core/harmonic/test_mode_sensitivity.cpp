#include <QTest>

#include "core/harmonic/mode_sensitivity.hpp"
#include "core/mechanics/family_parameter.hpp"
#include "core/mechanics/registry.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::LinearModes;

namespace {

struct Example {
  std::string name;
  std::shared_ptr<const Model> model;
  int modes;
  double step;  ///< of a parameter, relative to its value
};

/// A soft foil that gravity bends far down, with masses: its equilibrium moves with them, and with it its stiffness.
Model hangingFoil(double thickness) {
  StripOptions options;
  options.youngModulus = 3e8;
  options.thickness = thickness;
  const geometry::SurfaceMesh mesh = stripMesh(options);
  auto model = strip(options, mesh);
  const int last = static_cast<int>(mesh.points.cols()) - 1;
  addPointMass(*model, "tip", {last}, 2e-4);
  addPointMass(*model, "middle", {last / 2, last / 2 + 1}, 1e-4);
  model->gravity = vector3(0, 0, -9.81);
  model->drives = {mechanics::makeTranslation(clampedNodes(mesh, 0.02), vector3(0, 0, 1), sine(1e-3))};
  model->familyValues = {thickness};
  model->finish();
  return *model;
}

std::vector<Example> examples() {
  auto foil = std::make_shared<Model>(hangingFoil(4e-4));
  foil->parameters.push_back(
      mechanics::makeFamilyParameter(0, {"thickness", "/thickness", base::dimensions::length, 2e-4, 1e-3},
                                     std::make_shared<const mechanics::ModelFamily>(
                                         [](const std::vector<double>& values) { return hangingFoil(values[0]); })));
  std::vector<Example> list = {{"hanging foil", foil, 4, 2e-3}};
  for (const mechanics::ParameterKind& kind : mechanics::parameterKinds()) {
    std::mt19937 random(3);
    list.push_back({kind.name, std::make_shared<const Model>(kind.drivenExample(random)), 4, 2e-3});
  }
  return list;
}

LinearModes modesOf(std::shared_ptr<const Model> model, int count) {
  base::ExecutionContext context;
  harmonic::LinearModesOptions options;
  options.count = count;
  LinearModes modes = harmonic::computeLinearModes(HarmonicBalanceProblem(std::move(model), {3, 16}), options, context);
  if (!modes.report.converged()) QTest::qFail(modes.report.message.c_str(), __FILE__, __LINE__);
  return modes;
}

}  // namespace

class TestModeSensitivity : public QObject {
  Q_OBJECT

 private slots:
  void agreesWithDifferencesOfFrequencies_data();
  void agreesWithDifferencesOfFrequencies();
  void gravityShiftsWhatMassAloneWouldNot();
};

void TestModeSensitivity::agreesWithDifferencesOfFrequencies_data() {
  QTest::addColumn<int>("index");
  const auto list = examples();
  for (std::size_t i = 0; i < list.size(); ++i) QTest::newRow(list[i].name.c_str()) << static_cast<int>(i);
}

void TestModeSensitivity::agreesWithDifferencesOfFrequencies() {
  QFETCH(int, index);
  const Example example = examples()[static_cast<std::size_t>(index)];
  const Model& model = *example.model;
  const LinearModes modes = modesOf(example.model, example.modes);
  std::vector<int> chosen, parameters;
  for (std::size_t i = 0; i < modes.modes.size(); ++i) chosen.push_back(static_cast<int>(i));
  for (std::size_t p = 0; p < model.parameters.size(); ++p) parameters.push_back(static_cast<int>(p));
  const Matrix derivatives =
      harmonic::naturalFrequencyDerivatives(HarmonicBalanceProblem(example.model, {3, 16}), modes, chosen, parameters);
  for (std::size_t p = 0; p < model.parameters.size(); ++p) {
    const auto& parameter = *model.parameters[p];
    const double value = parameter.value(model), step = example.step * value;
    std::vector<LinearModes> moved;
    for (const double multiple : {-2, -1, 1, 2})
      moved.push_back(
          modesOf(std::make_shared<const Model>(parameter.withValue(model, value + multiple * step)), example.modes));
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const auto omega = [&](std::size_t k) { return moved[k].modes[i].omega; };
      const double difference = (8 * (omega(2) - omega(1)) - (omega(3) - omega(0))) / (12 * step);
      const double found = derivatives(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(p));
      const double error = std::abs(found - difference) * value / modes.modes[i].omega;
      qInfo("mode %zu by %s: %.7g, difference %.7g", i, parameter.name().c_str(), found, difference);
      QVERIFY2(error < 1e-6, qPrintable(QString::number(error)));
    }
  }
}

/// Without the equilibrium's shift, a mass that hangs on a foil would change its frequency by its inertia alone.
void TestModeSensitivity::gravityShiftsWhatMassAloneWouldNot() {
  auto hanging = std::make_shared<Model>(hangingFoil(4e-4));
  const LinearModes modes = modesOf(hanging, 1);
  const Vector& shape = modes.modes[0].shape;
  double inertia = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int f = hanging->dofs.freeIndex[static_cast<std::size_t>(hanging->pointMasses[0].nodes[0] * 3 + axis)];
    inertia += shape[f] * shape[f];
  }
  const double whole =
      harmonic::naturalFrequencyDerivatives(HarmonicBalanceProblem(hanging, {3, 16}), modes, {0}, {0})(0, 0);
  const double byInertia = -0.5 * modes.modes[0].omega * inertia;
  QVERIFY(std::abs(whole - byInertia) > 0.01 * std::abs(byInertia));
}

QTEST_GUILESS_MAIN(TestModeSensitivity)
#include "test_mode_sensitivity.moc"
