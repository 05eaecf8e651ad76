#include <QTemporaryDir>
#include <QTest>

#include "core/base/error.hpp"
#include "core/harmonic/response_sensitivity.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"

using namespace pliant;
using harmonic::Vector;
using scene::Json;
using scene::Scene;

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

/// Two rigid links and a spring between points of them, in the plane, shaken at the hip.
const char* const links = R"({
  "schema_version": 1, "dimension": 2,
  "geometry": [{"name": "joints", "type": "points", "points": [[0, 0], [0.06, -0.12], [-0.04, -0.23]]}],
  "elements": [{"name": "thigh", "type": "link", "joints": [0, 1], "mass": "30 g"},
               {"name": "shank", "type": "link", "joints": [1, 2], "mass": "30 g"}],
  "point_masses": [{"name": "ankle", "at": {"nodes": [2]}, "mass": "50 g"}],
  "springs": [{"name": "knee", "type": "local", "from": {"type": "link", "link": "thigh", "along": "30 mm", "across": "-20 mm"},
               "to": {"type": "link", "link": "shank", "along": "110 mm", "across": "-20 mm"}, "rest_length": "0.146 m",
               "coefficients": ["70 N/m"]}],
  "drives": [{"name": "hip", "type": "translation", "at": {"nodes": [0]}, "direction": [0, 1],
              "harmonics": [{"amplitude": "1 mm", "phase": 0.2}]}],
  "loads": [{"name": "gravity", "type": "gravity", "acceleration": [0, -9.81]}],
  "damping": {"mass_proportional": 1, "stiffness_proportional": "1 ms"},
  "parameters": [PARAMETERS], "probes": [{"name": "end", "at": {"nodes": [2]}}], "studies": []
})";

/// A bent wire with a mass at its end.
const char* const wire = R"({
  "schema_version": 1,
  "geometry": [{"name": "wire", "type": "mesh", "points": [[0, 0, 0], [0.05, 0, 0], [0.1, 0.02, 0], [0.15, 0.02, 0.03]],
                "segments": [[0, 1], [1, 2], [2, 3]]}],
  "materials": [{"name": "steel", "density": 7800, "young_modulus": "210 GPa", "poisson_ratio": 0.3}],
  "elements": [{"name": "rod", "type": "rod", "diameter": "1 mm"}],
  "point_masses": [{"name": "end", "at": {"nodes": [3]}, "mass": "5 g"}],
  "drives": [{"name": "clamp", "type": "rotation", "at": {"nodes": [0]}, "center": [0, 0, 0], "axis": [0, 1, 0],
              "harmonics": [{"amplitude": "3 deg", "phase": 0.2}]}],
  "damping": {"mass_proportional": 2, "stiffness_proportional": "1 ms"},
  "parameters": [PARAMETERS], "probes": [{"name": "end", "at": {"nodes": [3]}}], "studies": []
})";

/// Two layers of a solid, each of a material of its own.
const char* const layers = R"({
  "schema_version": 1,
  "geometry": [{"name": "body", "type": "blocks", "cell": [0.02, 0.01, 0.02],
                "blocks": [{"name": "lower", "minimum": [0, 0, 0], "maximum": [0.06, 0.01, 0.02]},
                           {"name": "upper", "minimum": [0, 0.01, 0], "maximum": [0.06, 0.02, 0.02]}]}],
  "materials": [{"name": "soft", "density": 1000, "young_modulus": "0.2 MPa", "poisson_ratio": 0.4},
                {"name": "stiff", "density": 1000, "young_modulus": "0.4 MPa", "poisson_ratio": 0.4}],
  "elements": [{"name": "lower", "type": "solid", "material": "soft", "group": "lower"},
               {"name": "upper", "type": "solid", "material": "stiff", "group": "upper"}],
  "drives": [{"name": "clamp", "type": "translation", "at": {"group": "lower.x_min"}, "direction": [0, 1, 0],
              "harmonics": [{"amplitude": "4 mm", "phase": 0.3}]}],
  "damping": {"mass_proportional": 2, "stiffness_proportional": "1 ms"},
  "point_masses": [{"name": "end", "at": {"group": "upper.x_max"}, "mass": "1 g"}],
  "parameters": [PARAMETERS], "probes": [{"name": "end", "at": {"nearest": [0.06, 0.02, 0]}}], "studies": []
})";

scene::Scene sceneWith(const std::string& parameters, const char* base = strip) {
  std::string text = base;
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
  void frequenciesAreThoseOfTheirStudies();
  void badParametersAreRefused();
};

void TestSceneParameters::sensitivitiesAgreeWithWholeSolves_data() {
  QTest::addColumn<QString>("scene");
  QTest::addColumn<QString>("pointer");
  for (const char* pointer :
       {"/springs/0/rest_length", "/springs/0/coefficients/0", "/springs/0/from/along", "/springs/0/from/across",
        "/springs/0/to/along", "/springs/0/to/across", "/geometry/0/points/1/0", "/geometry/0/points/2/1",
        "/elements/0/mass", "/drives/0/harmonics/0/amplitude", "/drives/0/harmonics/0/phase",
        "/damping/mass_proportional", "/damping/stiffness_proportional"})
    QTest::addRow("links %s", pointer) << links << pointer;
  for (const char* pointer :
       {"/geometry/0/points/1/0", "/geometry/0/points/3/2", "/elements/0/diameter", "/materials/0/young_modulus",
        "/drives/0/harmonics/0/amplitude", "/drives/0/harmonics/0/phase", "/damping/stiffness_proportional"})
    QTest::addRow("wire %s", pointer) << wire << pointer;
  for (const char* pointer : {"/materials/0/young_modulus", "/materials/1/young_modulus"})
    QTest::addRow("layers %s", pointer) << layers << pointer;
  for (const char* pointer :
       {"/materials/0/young_modulus", "/materials/0/poisson_ratio", "/materials/0/density", "/elements/0/thickness",
        "/geometry/0/length", "/springs/0/coefficients/0", "/springs/0/anchor/0", "/drives/0/harmonics/0/amplitude",
        "/drives/0/harmonics/0/phase", "/loads/0/acceleration/1", "/damping/mass_proportional",
        "/damping/stiffness_proportional"})
    QTest::newRow(pointer) << strip << pointer;
}

void TestSceneParameters::sensitivitiesAgreeWithWholeSolves() {
  QFETCH(QString, scene);
  QFETCH(QString, pointer);
  const QByteArray text = scene.toUtf8();
  const auto model = scene::buildModel(sceneWith(entry("p", pointer.toStdString()), text.constData()));
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

/// Every study of a kind with a frequency may have it as a parameter, which other studies do not see.
void TestSceneParameters::frequenciesAreThoseOfTheirStudies() {
  Json json = Json::parse(sceneWith(entry("thickness", "/elements/0/thickness")).json().dump());
  const Json study = {{"name", "slow"}, {"type", "periodic_motion"}, {"frequency", 14}, {"harmonics", 3}};
  json["studies"] = {study, study};
  json["studies"][1]["name"] = "fast";
  json["studies"][1]["frequency"] = "16 rad/s";
  for (const char* index : {"0", "1"})
    json["parameters"].push_back(
        {{"name", std::string("frequency ") + index}, {"pointer", std::string("/studies/") + index + "/frequency"}});
  const Scene scene = Scene::parse(json.dump(), {}, "scene.json");
  const auto model = scene::buildModel(scene);
  QCOMPARE(model->parameters.size(), std::size_t(4));
  QCOMPARE(model->parameters[3]->value(*model), 16.0);
  QCOMPARE(model->parameters[3]->maximum(*model), 32.0);
  base::ExecutionContext context;
  const auto run = [&](const Scene& of, const char* name) {
    const auto made = scene::StudyRegistry::instance().make(of, scene::buildModel(of), name)->run(context);
    return std::dynamic_pointer_cast<const scene::HarmonicResult>(made);
  };
  const auto fast = run(scene, "fast");
  const mechanics::Model& own = fast->problem->model();
  QCOMPARE(own.parameters.size(), std::size_t(3));
  QCOMPARE(own.parameters[2]->name(), std::string("frequency 1"));
  // The derivative that the result has, against motions at other frequencies.
  const Vector derivative = fast->sensitivity->derivative().col(2);
  const double step = 0.02;
  const auto at = [&](double change) {
    return run(scene.withValue("/studies/1/frequency", 16 + change), "fast")->points[0].z;
  };
  const Vector difference = (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
  const double error = (derivative - difference).norm() / difference.norm();
  QVERIFY2(error <= 1e-5, qPrintable(QString::number(error)));
  // A result that is written is read with the parameters of its study.
  QTemporaryDir directory;
  const std::filesystem::path folder = directory.filePath("fast").toStdString();
  fast->write(folder);
  const auto read = scene::HarmonicResult::read(scene, folder);
  QCOMPARE(read->problem->model().parameters.size(), std::size_t(3));
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
  QVERIFY(mentions(refusal(entry("p", "/studies/0/frequency")), "/parameters/0/pointer"));  // there is none
  QVERIFY(mentions(refusal(entry("p", "/elements/0/thickness", ", \"minimum\": 1")), "/parameters/0/maximum"));
  QVERIFY(mentions(refusal(entry("p", "/elements/0/thickness", ", \"maximum\": 0.004")), "not between"));
  QVERIFY(mentions(refusal(entry("p", "/elements/0/thickness") + "," + entry("q", "/elements/0/thickness")),
                   "/parameters/1/pointer"));
}

QTEST_GUILESS_MAIN(TestSceneParameters)
#include "test_scene_parameters.moc"
