#include <Eigen/LU>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/design_result.hpp"
#include "core/scene/model_builder.hpp"

using namespace pliant;
using scene::DesignResult;
using scene::Json;
using scene::Scene;

namespace {

constexpr double omega = 1.2, alpha = 0.1, force = 0.1;

/// m x'' + α m x' + x = F cos ωt, beside a post that stands at x = 0.5, and a sheet that is pulled along x.
const std::string text = R"({
  "schema_version": 1, "dimension": 2,
  "geometry": [
    {"name": "body", "type": "points", "points": [[0, 0], [0.5, 0]]},
    {"name": "sheet", "type": "mesh", "points": [[5, 0], [6, 0], [5, 1], [6, 1]], "triangles": [[0, 1, 2], [1, 3, 2]]}],
  "materials": [{"name": "rubber", "type": "isotropic", "density": 1, "young_modulus": 1e4, "poisson_ratio": 0.3}],
  "elements": [{"name": "skin", "type": "membrane", "geometry": "sheet", "thickness": 0.01}],
  "point_masses": [{"name": "mass", "at": {"geometry": "body", "nodes": [0]}, "mass": 2, "minimum": 0.2, "maximum": 3},
                   {"name": "corner", "at": {"geometry": "sheet", "nodes": [3]}, "mass": 0.2, "maximum": 30}],
  "springs": [{"name": "spring", "type": "grounded", "at": {"geometry": "body", "nodes": [0]}, "direction": [1, 0],
               "coefficients": [1]}],
  "boundary_conditions": [
    {"name": "rail", "type": "locked", "at": {"geometry": "body", "nodes": [0]}, "coordinates": ["y"]},
    {"name": "post", "type": "locked", "at": {"geometry": "body", "nodes": [1]}},
    {"name": "wall", "type": "locked", "at": {"geometry": "sheet", "nodes": [0, 2]}}],
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"geometry": "body", "nodes": [0]}, "direction": [1, 0],
             "harmonics": [{"amplitude": 0.1}]},
            {"name": "pull", "type": "harmonic_force", "at": {"geometry": "sheet", "nodes": [3]}, "direction": [1, 0],
             "harmonics": [{"amplitude": 0.5}]}],
  "damping": {"mass_proportional": 0.1},
  "probes": [{"name": "body", "at": {"geometry": "body", "nodes": [0]}},
             {"name": "post", "at": {"geometry": "body", "nodes": [1]}},
             {"name": "corner", "at": {"geometry": "sheet", "nodes": [3]}}],
  "studies": [{"name": "design", "type": "design", "frequency": 1.2, "harmonics": 3, "samples": 16,
               "gradient_tolerance": 1e-7, "parameters": ["mass"],
               "objectives": [{"type": "amplitude", "probes": ["body"]}],
               "constraints": [{"type": "total_mass", "at_most": 0.75}]}]
})";

double amplitudeOf(double mass) { return force / std::hypot(1 - mass * omega * omega, alpha * mass * omega); }

Scene sceneWith(const Json& constraints, const std::function<void(Json&)>& edit = {}) {
  Json json = Json::parse(text);
  json["studies"][0]["constraints"] = constraints;
  if (edit) edit(json["studies"][0]);
  return Scene::parse(json.dump(), "/nowhere", "test.json");
}

std::shared_ptr<const DesignResult> run(const Scene& scene) {
  base::ExecutionContext context;
  const auto study = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "design");
  return std::dynamic_pointer_cast<const DesignResult>(study->run(context));
}

}  // namespace

class TestDesignConstraints : public QObject {
  Q_OBJECT

 private slots:
  void keepsToAMass();
  void keepsAwayFromWhatIsThere_data();
  void keepsAwayFromWhatIsThere();
  void keepsToAStrain();
  void keepsToAStress();
  void refusesRods();
  void writesConstraints();
  void warnsIfTheyAreBroken();
  void refusesWrongInput_data();
  void refusesWrongInput();
  void beginsFromSeveralDesigns();
};

/// All masses count: 0.01 kg of the sheet, 0.2 kg at its corner.
void TestDesignConstraints::keepsToAMass() {
  const auto result = run(sceneWith(Json::array({{{"type", "total_mass"}, {"equal", "0.75 kg"}}})));
  QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
  const double mass = 0.75 - 0.21;
  QVERIFY(std::abs(result->after().values[0] - mass) < 1e-5);
  QVERIFY(std::abs(result->after().amplitudes[0].pathLength - 4 * amplitudeOf(mass)) < 1e-4);
}

void TestDesignConstraints::keepsAwayFromWhatIsThere_data() {
  QTest::addColumn<QString>("from");
  QTest::newRow("plane") << R"("plane": {"point": [0.5, 7], "normal": [-2, 0]})";
  QTest::newRow("circle") << R"("sphere": {"centre": [0.9, 0], "radius": "40 cm"})";
  QTest::newRow("node") << R"("node": {"probe": "post"})";
}

/// All three are 0.5 m to the right; half of it is to remain.
void TestDesignConstraints::keepsAwayFromWhatIsThere() {
  QFETCH(QString, from);
  const std::string constraint =
      R"([{"type": "clearance", "probes": ["body"], "at_least": "25 cm", )" + from.toStdString() + "}]";
  const auto result = run(sceneWith(Json::parse(constraint)));
  QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
  const double swing = result->after().amplitudes[0].maximumDisplacement;
  QVERIFY(swing < 0.25 + 1e-5 && swing > 0.25 - 1e-4 * std::log(512.0) - 1e-5);
  QVERIFY(std::abs(result->summary()["constraints"][0]["value"].get<double>() - (0.5 - swing)) < 1e-5);
  QVERIFY(amplitudeOf(1 / (omega * omega + alpha * alpha)) > 0.5);  // without it there would be a collision
}

/// The heavier its corner the more the sheet is strained at this frequency, far below its resonance.
void TestDesignConstraints::keepsToAStrain() {
  const auto chooseCorner = [](Json& study) {
    study["parameters"] = {"corner"};
    study["objectives"][0]["probes"] = {"corner"};
  };
  const Json rule{{"type", "strain"}, {"at_most", 0.012}, {"geometries", {"sheet"}}};
  const auto result = run(sceneWith(Json::array({rule}), chooseCorner));
  QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
  const Json constraint = result->summary()["constraints"][0];
  const double strain = constraint["value"], smooth = constraint["smooth_value"];
  QVERIFY2(std::abs(smooth - 0.012) < 1e-6, qPrintable(QString::number(smooth)));
  QVERIFY(strain <= smooth && strain > 0.012 * (1 - std::log(128.0) / 300));
  QVERIFY(constraint["value_before"] < 0.9 * strain);
  QVERIFY(std::abs(harmonic::largestStrain(*result->motionOf(result->after())->problem, result->after().z) - strain) <
          1e-5);
}

/// The von Mises stress of the sheet's two triangles, in small steps of time, from the definition: F, S, F S Fᵀ / J.
double largestStressOf(const scene::HarmonicResult& motion) {
  const double young = 1e4, nu = 0.3;
  double largest = 0;
  for (int i = 0; i < 4096; ++i) {
    const auto x = motion.problem->configurationAt(motion.points[0].z, 2 * M_PI * i / 4096);
    const auto at = [&](int node) { return Eigen::Vector2d(x.segment<2>(2 * (2 + node))); };
    for (const auto& [a, b, c] : {std::array{0, 1, 2}, std::array{1, 3, 2}}) {
      Eigen::Matrix2d rest, now;
      const Eigen::Matrix<double, 2, 4> corners = (Eigen::Matrix<double, 2, 4>() << 5, 6, 5, 6, 0, 0, 1, 1).finished();
      rest << corners.col(b) - corners.col(a), corners.col(c) - corners.col(a);
      now << at(b) - at(a), at(c) - at(a);
      const Eigen::Matrix2d f = now * rest.inverse(), strain = 0.5 * (f.transpose() * f - Eigen::Matrix2d::Identity());
      const Eigen::Matrix2d s =
          young / (1 - nu * nu) * ((1 - nu) * strain + nu * strain.trace() * Eigen::Matrix2d::Identity());
      const double thinning = std::sqrt(1 - 2 * nu / (1 - nu) * strain.trace());
      const Eigen::Matrix2d cauchy = f * s * f.transpose() / (f.determinant() * thinning);
      const double xx = cauchy(0, 0), yy = cauchy(1, 1), xy = cauchy(0, 1);
      largest = std::max(largest, std::sqrt(xx * xx - xx * yy + yy * yy + 3 * xy * xy));
    }
  }
  return largest;
}

void TestDesignConstraints::keepsToAStress() {
  const auto chooseCorner = [](Json& study) {
    study["parameters"] = {"corner"};
    study["objectives"][0]["probes"] = {"corner"};
  };
  const auto result = run(sceneWith(Json::parse(R"([{"type": "stress", "at_most": "0.12 kPa"}])"), chooseCorner));
  QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
  const Json constraint = result->summary()["constraints"][0];
  const double stress = constraint["value"], smooth = constraint["smooth_value"];
  QVERIFY2(std::abs(smooth - 120) < 1e-3, qPrintable(QString::number(smooth)));
  QVERIFY(stress <= smooth && stress > 120 * (1 - std::log(2 * 128.0) / 300));
  QVERIFY(constraint["value_before"] < 0.9 * stress);
  const double expected = largestStressOf(*result->motionOf(result->after()));
  QVERIFY2(std::abs(stress / expected - 1) < 1e-4, qPrintable(QString::number(stress / expected)));
}

void TestDesignConstraints::refusesRods() {
  const std::string wire = R"({
    "schema_version": 1, "dimension": 3,
    "geometry": [{"name": "wire", "type": "mesh", "points": [[0, 0, 0], [1, 0, 0], [2, 0, 0]],
                  "segments": [[0, 1], [1, 2]]},
                 {"name": "leaf", "type": "mesh", "points": [[5, 0, 0], [6, 0, 0], [5, 1, 0]], "triangles": [[0, 1, 2]]}],
    "materials": [{"name": "steel", "type": "isotropic", "density": 8000, "young_modulus": 1e9, "poisson_ratio": 0.3}],
    "elements": [{"name": "rod", "type": "rod", "geometry": "wire", "diameter": 0.01},
                 {"name": "skin", "type": "membrane", "geometry": "leaf", "thickness": 0.01}],
    "point_masses": [{"name": "mass", "at": {"geometry": "wire", "nodes": [2]}, "mass": 2}],
    "boundary_conditions": [{"name": "wall", "type": "locked", "at": {"geometry": "wire", "nodes": [0, 1]}},
                            {"name": "frame", "type": "locked", "at": {"geometry": "leaf", "nodes": [0, 1]}}],
    "probes": [{"name": "end", "at": {"geometry": "wire", "nodes": [2]}}],
    "studies": [{"name": "design", "type": "design", "frequency": 1.2, "harmonics": 3,
                 "objectives": [{"type": "amplitude", "probes": ["end"]}],
                 "constraints": [{"type": "stress", "at_most": 1}]}]
  })";
  const auto make = [](const Scene& scene) {
    return scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "design");
  };
  try {
    make(Scene::parse(wire, "/nowhere", "test.json"));
    QFAIL("nothing was refused");
  } catch (const base::InputError& error) {
    QCOMPARE(error.location(), "test.json: /studies/0/constraints/0");
    QVERIFY(QString::fromStdString(error.problem()).contains("rod"));
  }
  Json json = Json::parse(wire);
  json["studies"][0]["constraints"][0]["geometries"] = {"leaf"};
  QVERIFY(make(Scene::parse(json.dump(), "/nowhere", "test.json")) != nullptr);
}

void TestDesignConstraints::writesConstraints() {
  const auto result = run(sceneWith(Json::parse(R"([{"type": "total_mass", "at_most": 0.75, "at_least": 0.5},
                                    {"type": "clearance", "probes": ["body", "post"], "at_least": "-1 m",
                                     "plane": {"point": [9, 0], "normal": [-1, 0]}}])")));
  QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
  const Json summary = result->summary();
  QCOMPARE(summary["constraints"].size(), std::size_t(2));
  QCOMPARE(summary["constraints"][0]["at_least"].get<double>(), 0.5);
  QVERIFY(summary["constraints"][1]["at_most"].is_null());
  QVERIFY(std::abs(summary["constraints"][0]["value_before"].get<double>() - 2.21) < 1e-12);
  QVERIFY(summary["constraint_violation"].get<double>() <= 1e-6);
  QVERIFY(summary["optimality_residual"].get<double>() < 1e-5);
  QVERIFY(summary["constraints"][0]["multiplier"].get<double>() > 0);
  QCOMPARE(summary["constraints"][1]["multiplier"].get<double>(), 0.0);
  QVERIFY(summary["warnings"].empty());
  QTemporaryDir directory;
  const std::filesystem::path folder = directory.filePath("design").toStdString();
  result->write(folder);
  const scene::CsvTable history(folder / "history.csv");
  QCOMPARE(history.size(), result->design.history.size());
  QVERIFY(std::abs(history.number(0, "total mass") - 2.21) < 1e-12);
  QCOMPARE(history.number(history.size() - 1, "total mass"), summary["constraints"][0]["value"].get<double>());
  QVERIFY(history.has("clearance of body and post"));
}

void TestDesignConstraints::warnsIfTheyAreBroken() {
  const auto result = run(sceneWith(Json::parse(R"([{"type": "total_mass", "at_most": 0.3}])")));
  QVERIFY(result->termination != base::TerminationType::converged);
  QVERIFY(!result->message.empty());
  QVERIFY(result->summary()["constraint_violation"].get<double>() > 0.3);
  QVERIFY(!result->warnings().empty());
}

void TestDesignConstraints::refusesWrongInput_data() {
  QTest::addColumn<QString>("constraint");
  QTest::addColumn<QString>("place");
  const auto row = [](const char* name, const char* constraint, const char* place) {
    QTest::newRow(name) << constraint << QString("test.json: /studies/0/constraints/0") + place;
  };
  row("no bound", R"({"type": "total_mass"})", "");
  row("bounds beside an equation", R"({"type": "total_mass", "equal": 1, "at_most": 2})", "/equal");
  row("bounds that cross", R"({"type": "total_mass", "at_least": 3, "at_most": 2})", "/at_least");
  row("nothing to strain", R"({"type": "strain", "at_most": 0.1, "geometries": ["body"]})", "");
  row("nothing to stress", R"({"type": "stress", "at_most": 100, "geometries": ["body"]})", "");
  row("no stress", R"({"type": "stress", "at_most": 0})", "/at_most");
  row("unknown geometry", R"({"type": "strain", "at_most": 0.1, "geometries": ["skin"]})", "/geometries/0");
  row("from nothing", R"({"type": "clearance", "probes": ["body"]})", "");
  row("no direction", R"({"type": "clearance", "probes": ["body"], "plane": {"point": [0, 0], "normal": [0, 0]}})",
      "/plane/normal");
  row("from itself", R"({"type": "clearance", "probes": ["post", "body"], "node": {"probe": "body"}})", "/node/probe");
}

void TestDesignConstraints::refusesWrongInput() {
  QFETCH(QString, constraint);
  QFETCH(QString, place);
  try {
    run(sceneWith(Json::array({Json::parse(constraint.toStdString())})));
    QFAIL("nothing was refused");
  } catch (const base::InputError& error) {
    QCOMPARE(QString::fromStdString(error.location()), place);
    QVERIFY(QString::fromStdString(error.problem()).endsWith('.'));
  }
}

/// The scene's own mass is above that of the resonance, 0.7, and designs between the bounds lie on both sides.
void TestDesignConstraints::beginsFromSeveralDesigns() {
  const auto result = run(
      sceneWith(Json::array({{{"type", "total_mass"}, {"at_most", 0.75}}}), [](Json& study) { study["starts"] = 3; }));
  QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
  QVERIFY(std::abs(result->after().values[0] - (0.75 - 0.21)) < 1e-5);
  const Json summary = result->summary();
  QCOMPARE(summary["starts"].size(), std::size_t(3));
  for (const Json& start : summary["starts"]) QVERIFY(start["constraint_violation"].get<double>() <= 1e-6);
  QVERIFY(summary["constraint_violation"].get<double>() <= 1e-6);
  QVERIFY(std::abs(summary["constraints"][0]["value"].get<double>() - 0.75) < 1e-5);
}

QTEST_GUILESS_MAIN(TestDesignConstraints)
#include "test_design_constraints.moc"
