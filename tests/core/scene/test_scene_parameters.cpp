#include <QTest>

#include "core/base/error.hpp"
#include "core/harmonic/response_sensitivity.hpp"
#include "core/scene/model_builder.hpp"

using namespace pliant;
using harmonic::Vector;

namespace {

/// A shaken strip in the plane, held by a spring, whose every number may be a parameter.
const char* const strip = R"({
  "schema_version": 1, "dimension": 2,
  "geometry": [{"name": "strip", "type": "strip", "length": "150 mm", "width": "20 mm", "length_cells": 5}],
  "materials": [{"name": "rubber", "density": 1100, "young_modulus": "0.5 MPa", "poisson_ratio": 0.4}],
  "elements": [{"name": "body", "type": "membrane", "thickness": "5 mm"}],
  "point_masses": [{"name": "end", "at": {"group": "end"}, "mass": "1 g"}],
  "springs": [{"name": "guy", "type": "anchored", "at": {"nearest": ["90 mm", "10 mm"]}, "anchor": [0.1, 0.2],
               "coefficients": ["3 N/m"]}],
  "drives": [{"name": "clamp", "type": "translation", "at": {"group": "start"}, "direction": [0, 1],
              "harmonics": [{"amplitude": "4 mm", "phase": 0.3}]}],
  "loads": [{"name": "gravity", "type": "gravity", "acceleration": [0, -9.81]}],
  "damping": {"mass_proportional": 2, "stiffness_proportional": "1 ms"},
  "parameters": [PARAMETERS],
  "probes": [{"name": "end", "at": {"nearest": [0.15, 0]}}],
  "studies": []
})";

scene::Scene sceneWith(const std::string& parameters) {
  std::string text = strip;
  text.replace(text.find("PARAMETERS"), 10, parameters);
  return scene::Scene::parse(text, {}, "scene.json");
}

std::string entry(const std::string& name, const std::string& pointer, const std::string& more = "") {
  return "{\"name\": \"" + name + "\", \"pointer\": \"" + pointer + "\"" + more + "}";
}

harmonic::PeriodicMotion solve(const harmonic::HarmonicBalanceProblem& given, const Vector& start) {
  harmonic::HarmonicBalanceProblem problem = given;
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions options;
  options.tolerance = 1e-13;
  options.stepTolerance = 1e-13;
  return harmonic::solvePeriodicMotion(problem, 14, options, context, start);
}

}  // namespace

/// Any number of the scene as a design parameter: sensitivities against differences of whole solves.
class TestSceneParameters : public QObject {
  Q_OBJECT

 private slots:
  void sensitivitiesAgreeWithWholeSolves_data();
  void sensitivitiesAgreeWithWholeSolves();
  void parametersChangeTogether();
  void badParametersAreRefused();
};

void TestSceneParameters::sensitivitiesAgreeWithWholeSolves_data() {
  QTest::addColumn<QString>("pointer");
  for (const char* pointer :
       {"/materials/0/young_modulus", "/materials/0/poisson_ratio", "/materials/0/density", "/elements/0/thickness",
        "/geometry/0/length", "/springs/0/coefficients/0", "/springs/0/anchor/0", "/drives/0/harmonics/0/amplitude",
        "/drives/0/harmonics/0/phase", "/loads/0/acceleration/1", "/damping/mass_proportional",
        "/damping/stiffness_proportional"})
    QTest::newRow(pointer) << pointer;
}

void TestSceneParameters::sensitivitiesAgreeWithWholeSolves() {
  QFETCH(QString, pointer);
  const auto model = scene::buildModel(sceneWith(entry("p", pointer.toStdString())));
  QCOMPARE(model->parameters.size(), std::size_t(2));
  const mechanics::DesignParameter& parameter = *model->parameters.back();
  QCOMPARE(parameter.pointer(), pointer.toStdString());
  const math::HarmonicBasis basis(3, 24);
  const harmonic::HarmonicBalanceProblem problem(model, basis);
  const harmonic::PeriodicMotion motion = solve(problem, {});
  QVERIFY(motion.report.converged());
  const Vector derivative = harmonic::ResponseSensitivity(problem, motion).derivative().col(1);

  const double value = parameter.value(*model), step = 1e-3 * std::abs(value);
  const auto solved = [&](double by) {
    const auto changed = std::make_shared<const mechanics::Model>(parameter.withValue(*model, value + by));
    return solve(harmonic::HarmonicBalanceProblem(changed, basis), motion.z).z;
  };
  const Vector difference =
      (8.0 * (solved(step) - solved(-step)) - (solved(2 * step) - solved(-2 * step))) / (12 * step);
  const double error = (derivative - difference).norm() / difference.norm();
  QVERIFY2(error <= 1e-6, qPrintable(QString::number(error)));
}

void TestSceneParameters::parametersChangeTogether() {
  const scene::Scene scene =
      sceneWith(entry("thickness", "/elements/0/thickness") + "," + entry("phase", "/drives/0/harmonics/0/phase"));
  const auto model = scene::buildModel(scene);
  QCOMPARE(model->parameters[0]->pointer(), std::string("/point_masses/0/mass"));
  QCOMPARE(model->parameters[1]->minimum(*model), 0.0025);
  QCOMPARE(model->parameters[1]->maximum(*model), 0.01);
  mechanics::Model changed = model->parameters[0]->withValue(*model, 2e-3);
  changed = model->parameters[1]->withValue(changed, 4e-3);
  changed = model->parameters[2]->withValue(changed, 1.0);
  const auto expected = scene::buildModel(scene.withValue("/point_masses/0/mass", 2e-3)
                                              .withValue("/elements/0/thickness", 4e-3)
                                              .withValue("/drives/0/harmonics/0/phase", 1.0));
  for (int i = 0; i < 3; ++i) QCOMPARE(model->parameters[i]->value(changed), expected->parameters[i]->value(*expected));
  QCOMPARE(mechanics::Matrix(changed.massMatrix()), mechanics::Matrix(expected->massMatrix()));
  const Vector free = Vector::Zero(changed.dofs.freeCount());
  QCOMPARE(changed.configuration(free, 0.4), expected->configuration(free, 0.4));
}

void TestSceneParameters::badParametersAreRefused() {
  const auto refusal = [](const std::string& parameters) {
    try {
      scene::buildModel(sceneWith(parameters));
    } catch (const base::InputError& error) {
      return error.location() + " " + error.problem();
    }
    return std::string();
  };
  const auto mentions = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  QCOMPARE(refusal(entry("p", "/elements/0/thickness")), std::string());
  QVERIFY(mentions(refusal(entry("p", "/elements/0/width")), "scene.json: /parameters/0/pointer"));
  QVERIFY(mentions(refusal(entry("p", "elements")), "/parameters/0/pointer"));
  QVERIFY(mentions(refusal(entry("p", "/geometry/0/length_cells")), "/parameters/0/pointer"));
  QVERIFY(mentions(refusal(entry("p", "/point_masses/0/mass")), "parameters of their own"));
  QVERIFY(mentions(refusal(entry("p", "/elements/0/thickness", ", \"minimum\": 1")), "/parameters/0/maximum"));
  QVERIFY(mentions(refusal(entry("p", "/elements/0/thickness", ", \"maximum\": 0.004")), "not between"));
  QVERIFY(mentions(refusal(entry("p", "/elements/0/thickness") + "," + entry("q", "/elements/0/thickness")),
                   "/parameters/1/pointer"));
}

QTEST_GUILESS_MAIN(TestSceneParameters)
#include "test_scene_parameters.moc"
