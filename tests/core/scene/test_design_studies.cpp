#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/design_result.hpp"
#include "core/scene/designed_scene.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"
#include "core/scene/target_path.hpp"

using namespace pliant;
using scene::DesignResult;
using scene::Json;
using scene::Scene;

namespace {

constexpr double omega = 1.2, alpha = 0.1, force = 0.1;

/// m x'' + α m x' + x = F cos ωt, and beside it a strip that is pulled along x.
const std::string text = R"({
  "schema_version": 1, "dimension": 2,
  "geometry": [
    {"name": "body", "type": "points", "points": [[0, 0]]},
    {"name": "sheet", "type": "mesh", "points": [[5, 0], [6, 0], [5, 1], [6, 1]], "triangles": [[0, 1, 2], [1, 3, 2]]}],
  "materials": [{"name": "rubber", "type": "isotropic", "density": 1, "young_modulus": 1e4, "poisson_ratio": 0.3}],
  "elements": [{"name": "skin", "type": "membrane", "geometry": "sheet", "thickness": 0.01,
                "stiffness_factors": [1, 2]}],
  "point_masses": [{"name": "mass", "at": {"geometry": "body", "nodes": [0]}, "mass": 2, "minimum": 0.2, "maximum": 3},
                   {"name": "corner", "at": {"geometry": "sheet", "nodes": [3]}, "mass": 0.2, "maximum": 1}],
  "springs": [{"name": "spring", "type": "grounded", "at": {"geometry": "body", "nodes": [0]}, "direction": [1, 0],
               "coefficients": [1]}],
  "boundary_conditions": [
    {"name": "rail", "type": "locked", "at": {"geometry": "body", "nodes": [0]}, "coordinates": ["y"]},
    {"name": "wall", "type": "locked", "at": {"geometry": "sheet", "nodes": [0, 2]}}],
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"geometry": "body", "nodes": [0]}, "direction": [1, 0],
             "harmonics": [{"amplitude": 0.1}]},
            {"name": "pull", "type": "harmonic_force", "at": {"geometry": "sheet", "nodes": [3]}, "direction": [1, 0],
             "harmonics": [{"amplitude": 0.02}]}],
  "damping": {"mass_proportional": 0.1},
  "parameters": [{"name": "stiffness", "pointer": "/springs/0/coefficients/0", "minimum": 0.5, "maximum": 4}],
  "probes": [{"name": "body", "at": {"geometry": "body", "nodes": [0]}},
             {"name": "corner", "at": {"geometry": "sheet", "nodes": [3]}}],
  "studies": [{"name": "design", "type": "design", "frequency": 1.2, "harmonics": 3, "samples": 16,
               "objective_tolerance": 1e-12, "gradient_tolerance": 1e-8,
               "parameters": ["mass"], "objectives": [{"type": "amplitude", "probes": ["body"]}]}]
})";

double pathLengthOf(double mass, double stiffness) {
  return 4 * force / std::hypot(stiffness - mass * omega * omega, alpha * mass * omega);
}

/// The scene with one of the study's keys changed (removed if null).
Scene withOption(const std::string& key, const Json& value, const std::filesystem::path& directory = "/nowhere") {
  Json json = Json::parse(text);
  if (value.is_null())
    json["studies"][0].erase(key);
  else
    json["studies"][0][key] = value;
  return Scene::parse(json.dump(), directory, "test.json");
}

std::shared_ptr<const DesignResult> run(const Scene& scene, const scene::ResultObserver& observe = {}) {
  base::ExecutionContext context;
  const auto study = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "design");
  return std::dynamic_pointer_cast<const DesignResult>(study->run(context, observe));
}

Json amplitude(const std::string& probe, const Json& target = {}) {
  Json objective{{"type", "amplitude"}, {"probes", Json::array({probe})}};
  if (!target.is_null()) objective["target"] = target;
  return objective;
}

}  // namespace

class TestDesignStudies : public QObject {
  Q_OBJECT

 private slots:
  void findsTheResonance();
  void takesAllParametersIfNoneAreNamed();
  void changesStiffnessElementByElement();
  void readsTargetPathsFromFiles();
  void splinesThroughAnEllipseAreNearlyAnEllipse();
  void writesItsTables();
  void showsEveryDesign();
  void designsAreTakenIntoTheScene();
  void refusesWrongInput_data();
  void refusesWrongInput();
};

void TestDesignStudies::findsTheResonance() {
  const auto result = run(withOption("iterations", 50));
  QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
  const Json summary = result->summary();
  const double best = 1 / (omega * omega + alpha * alpha);
  const Json& probe = summary["probes"][0];
  QVERIFY(std::abs(probe["path_length_before"].get<double>() - pathLengthOf(2, 1)) < 1e-7);
  QVERIFY(std::abs(probe["path_length"].get<double>() - pathLengthOf(best, 1)) < 1e-7);
  QVERIFY(std::abs(probe["gain"].get<double>() * pathLengthOf(2, 1) - pathLengthOf(best, 1)) < 1e-7);
  QVERIFY(std::abs(summary["parameters"][0]["value"].get<double>() - best) < 1e-4);
  QCOMPARE(summary["parameters"][0]["before"].get<double>(), 2.0);
  QCOMPARE(summary["parameter_count"].get<int>(), 1);
  QCOMPARE(summary["stability"].get<std::string>(), std::string("stable"));
  QVERIFY(summary["warnings"].empty());
  QVERIFY(summary["iterations"].get<int>() > 0 && summary["solves"] >= summary["evaluations"]);
  QVERIFY(summary["objective"].get<double>() < summary["objective_before"].get<double>());
}

/// The spring's stiffness is a parameter as well: lighter and softer is better, down to the stiffness's bound.
void TestDesignStudies::takesAllParametersIfNoneAreNamed() {
  const auto result = run(withOption("parameters", nullptr));
  QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
  const Json summary = result->summary();
  QCOMPARE(summary["parameter_count"].get<int>(), 3);
  for (const Json& parameter : summary["parameters"])
    if (parameter["name"] == "stiffness") QCOMPARE(parameter["value"].get<double>(), 0.5);
  const double best = 0.5 / (omega * omega + alpha * alpha);
  QVERIFY(std::abs(summary["probes"][0]["path_length"].get<double>() - pathLengthOf(best, 0.5)) < 1e-6);
}

/// The corner swings farther the softer the sheet is at so low a frequency, until it nears its resonance.
void TestDesignStudies::changesStiffnessElementByElement() {
  Json json = Json::parse(text);
  Json& study = json["studies"][0];
  study.erase("parameters");
  study["stiffness_factors"] = Json::array({{{"element", "skin"}, {"minimum", 0.5}, {"maximum", 4}}});
  study["objectives"] = Json::array({amplitude("corner")});
  const auto softest = run(Scene::parse(json.dump(), "/nowhere", "test.json"));
  QVERIFY2(softest->termination == base::TerminationType::converged, softest->message.c_str());
  const Json summary = softest->summary();
  QCOMPARE(summary["parameters"].size(), std::size_t(2));
  QCOMPARE(summary["parameters"][0]["before"].get<double>(), 1.0);
  QCOMPARE(summary["parameters"][1]["before"].get<double>(), 2.0);
  QCOMPARE(summary["parameters"][1]["pointer"].get<std::string>(), std::string("/elements/0/stiffness_factors/1"));
  QCOMPARE(summary["parameters"][0]["value"].get<double>(), 0.5);
  QCOMPARE(summary["parameters"][1]["value"].get<double>(), 0.5);

  // What it ends with is the motion of a scene with these factors.
  Json soft = Json::parse(text);
  soft["elements"][0]["stiffness_factors"] = {0.5, 0.5};
  const auto motion = run(Scene::parse(soft.dump(), "/nowhere", "test.json"));
  QVERIFY(std::abs(motion->before().amplitudes[1].pathLength - softest->after().amplitudes[1].pathLength) < 1e-8);

  study["stiffness_factors"][0]["initial"] = 3;
  const auto other = run(Scene::parse(json.dump(), "/nowhere", "test.json"));
  QVERIFY(other->before().values == Eigen::Vector2d(3, 3));
  QVERIFY(std::abs(other->after().amplitudes[1].pathLength - softest->after().amplitudes[1].pathLength) < 1e-6);
}

void TestDesignStudies::readsTargetPathsFromFiles() {
  QTemporaryDir folder;
  const std::filesystem::path directory = folder.path().toStdString();
  std::string table = "x [m],y [m]\n";
  const double wanted = 0.08;  // swing of the body
  for (int i = 0; i < 16; ++i) table += std::to_string(0.3 + wanted * std::sin(2 * M_PI * i / 16)) + ",0\n";
  scene::writeTextFile(directory / "path.csv", table);
  const Json fromFile{
      {"type", "path"}, {"paths", Json::array({{{"probe", "body"}, {"file", "path.csv"}}})}, {"phases", 2048}};
  const auto result = run(withOption("objectives", Json::array({fromFile}), directory));
  QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
  const Json summary = result->summary();
  QVERIFY(std::abs(summary["probes"][0]["path_length"].get<double>() - 4 * wanted) < 1e-3 * wanted);
  QVERIFY(summary["paths"][0]["error_before"].get<double>() > 0.1);
  QVERIFY(summary["paths"][0]["error"].get<double>() < 1e-3);

  Json points = Json::array();
  for (int i = 0; i < 16; ++i) points.push_back({wanted * std::sin(2 * M_PI * i / 16), 0});
  const Json inlinePath{
      {"type", "path"}, {"paths", Json::array({{{"probe", "body"}, {"points", points}}})}, {"phases", 2048}};
  const auto same = run(withOption("objectives", Json::array({inlinePath}), directory));
  QVERIFY(std::abs(same->after().values[0] - result->after().values[0]) < 1e-3);
}

/// Twelve points of a sine's path make a spline that misses it by less than a thousandth of its swing, so the design
/// ends where that for the sine itself does.
void TestDesignStudies::splinesThroughAnEllipseAreNearlyAnEllipse() {
  const auto designed = [](const std::string& form, int count) {
    Json places = Json::array();
    for (int i = 0; i < count; ++i) places.push_back({0.08 * std::cos(2 * std::numbers::pi * i / count), 0});
    const Json path{{"type", "path"}, {"paths", Json::array({{{"probe", "body"}, {form, places}}})}, {"phases", 2048}};
    return run(withOption("objectives", Json::array({path})));
  };
  const auto exact = designed("points", 64), spline = designed("spline", 12);
  QVERIFY(std::abs(spline->after().values[0] - exact->after().values[0]) <= 1e-3 * exact->after().values[0]);
  const Scene scene = withOption("objectives", Json::parse(R"([{"type": "path", "match_place": true, "paths": [
          {"probe": "corner", "points": [["1 cm", 0], [0, 1], [-1, 0]]},
          {"probe": "body", "spline": [[1, 0], [0, 1], [-1, 0], ["0", "-10 mm"]]}]}])"));
  const auto targets = scene::targetPaths(scene, *scene::buildModel(scene));
  QCOMPARE(targets.size(), std::size_t(2));
  QCOMPARE(targets[0].pointer, std::string("/studies/0/objectives/0/paths/0"));
  QCOMPARE(targets[0].places(0, 0), 0.01);
  QCOMPARE(targets[0].controlPoints.cols(), Eigen::Index(0));
  QCOMPARE(targets[1].probe, std::string("body"));
  QVERIFY(targets[1].matchPlace);
  QCOMPARE(targets[1].controlPoints.cols(), Eigen::Index(4));
  QCOMPARE(targets[1].controlPoints(1, 3), -0.01);
}

void TestDesignStudies::writesItsTables() {
  Json points = Json::array();
  for (int i = 0; i < 16; ++i) points.push_back({0.08 * std::sin(2 * M_PI * i / 16), 0});
  const Json path{{"type", "path"}, {"paths", Json::array({{{"probe", "body"}, {"points", points}}})}};
  const auto result = run(withOption("objectives", Json::array({path})));
  QTemporaryDir folder;
  const std::filesystem::path directory = std::filesystem::path(folder.path().toStdString()) / "design";
  result->write(directory);
  const scene::CsvTable history(directory / "history.csv");
  QCOMPARE(history.size(), result->design.history.size());
  for (std::size_t i = 0; i < history.size(); ++i) {
    QCOMPARE(history.integer(i, "iteration"), static_cast<int>(i));
    QCOMPARE(history.number(i, "body path length [m]"), result->design.history[i].amplitudes[0].pathLength);
    QCOMPARE(history.number(i, "mass [kg]"), result->design.history[i].values[0]);
  }
  const scene::CsvTable parameters(directory / "parameters.csv");
  QCOMPARE(parameters.size(), std::size_t(1));
  QCOMPARE(parameters.text(0, "unit"), std::string_view("kg"));
  QCOMPARE(parameters.number(0, "after"), result->after().values[0]);
  const scene::CsvTable trajectories(directory / "trajectories.csv");
  QCOMPARE(trajectories.size(), std::size_t(16));
  double largest = 0;  // distance of what came of it from the target, which is in phase with it
  for (std::size_t i = 0; i < 16; ++i)
    largest = std::max(
        largest, std::abs(trajectories.number(i, "body after x [m]") - trajectories.number(i, "body target x [m]")));
  QVERIFY(largest < 2e-3);
  const Json summary = scene::parseJson(scene::readTextFile(directory / "summary.json"));
  QCOMPARE(summary["kind"].get<std::string>(), std::string("design"));
  QCOMPARE(summary["iterations"].get<std::size_t>() + 1, history.size());
}

void TestDesignStudies::showsEveryDesign() {
  std::shared_ptr<const scene::Result> last;
  const auto result = run(withOption("iterations", 50), [&](const auto& shown) { last = shown; });
  QVERIFY(last == result);
  for (const harmonic::DesignIterate& design : result->design.history) {
    const auto motion = result->motionOf(design);
    const auto& point = motion->points[0];
    QVERIFY(motion->problem->residual(point.z, point.omega).norm() < 1e-8);
    QCOMPARE(point.amplitudes.size(), std::size_t(2));
  }
}

/// With stiffness factors that the scene does not write out, too.
void TestDesignStudies::designsAreTakenIntoTheScene() {
  Json json = Json::parse(text);
  json["elements"][0].erase("stiffness_factors");
  json["studies"][0].erase("parameters");
  json["studies"][0]["stiffness_factors"] = Json::parse(R"([{"element": "skin"}])");
  json["studies"][0]["parameters"] = {"mass", "stiffness"};
  json["studies"].push_back(
      Json::parse(R"({"name": "motion", "type": "periodic_motion", "frequency": 1.2, "harmonics": 3, "samples": 16})"));
  const Scene scene = Scene::parse(json.dump(), "/nowhere", "test.json");
  base::ExecutionContext context;
  const auto result = std::dynamic_pointer_cast<const DesignResult>(
      scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "design")->run(context));
  QVERIFY(result && result->design.history.size() > 2);
  for (const harmonic::DesignIterate* design : {&result->before(), &result->after()}) {
    const Scene taken = Scene::parse(scene::designedScene(scene, *result, *design).dump(), "/nowhere", "taken.json");
    const Json motion =
        scene::StudyRegistry::instance().make(taken, scene::buildModel(taken), "motion")->run(context)->summary();
    for (std::size_t i = 0; i < 2; ++i)
      QVERIFY(std::abs(motion["probes"][i]["path_length"].get<double>() / design->amplitudes[i].pathLength - 1) < 1e-6);
  }
}

void TestDesignStudies::refusesWrongInput_data() {
  QTest::addColumn<QString>("key");
  QTest::addColumn<QString>("value");
  QTest::addColumn<QString>("place");
  const auto row = [](const char* name, const char* key, const char* value, const char* place) {
    QTest::newRow(name) << key << value << place;
  };
  row("unknown parameter", "parameters", R"(["mess"])", "test.json: /studies/0/parameters/0");
  row("a parameter twice", "parameters", R"(["mass", "mass"])", "test.json: /studies/0/parameters/1");
  row("unknown probe", "objectives", R"([{"type": "amplitude", "probes": ["tip"]}])",
      "test.json: /studies/0/objectives/0/probes/0");
  row("no such axis", "objectives", R"([{"type": "amplitude", "probes": ["body"], "axes": ["z"]}])",
      "test.json: /studies/0/objectives/0/axes");
  row("points and file", "objectives", R"([{"type": "path", "paths": [{"probe": "body"}]}])",
      "test.json: /studies/0/objectives/0/paths/0");
  row("a path of one point", "objectives",
      R"([{"type": "path", "paths": [{"probe": "body", "points": [[0, 1], [0, 1], [0, 1]]}]}])",
      "test.json: /studies/0/objectives/0/paths");
  row("no such file", "objectives", R"([{"type": "path", "paths": [{"probe": "body", "file": "none.csv"}]}])",
      "/nowhere/none.csv");
  row("bounds that cross", "stiffness_factors", R"([{"element": "skin", "minimum": 3, "maximum": 2}])",
      "test.json: /studies/0/stiffness_factors/0/maximum");
  row("starts outside", "stiffness_factors", R"([{"element": "skin", "minimum": 1.5, "maximum": 4}])",
      "test.json: /studies/0/stiffness_factors/0");
  row("too few samples", "samples", "6", "test.json: /studies/0/samples");
}

void TestDesignStudies::refusesWrongInput() {
  QFETCH(QString, key);
  QFETCH(QString, value);
  QFETCH(QString, place);
  try {
    run(withOption(key.toStdString(), Json::parse(value.toStdString())));
    QFAIL("nothing was refused");
  } catch (const base::InputError& error) {
    QCOMPARE(QString::fromStdString(error.location()), place);
    QVERIFY(QString::fromStdString(error.problem()).endsWith('.'));
  }
}

QTEST_GUILESS_MAIN(TestDesignStudies)
#include "test_design_studies.moc"
