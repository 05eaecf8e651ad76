#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/design_space_result.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/result_charts.hpp"

using namespace pliant;
using scene::DesignSpaceResult;
using scene::Json;
using scene::Scene;

namespace {

/// m x'' + α m x' + k x = F cos ωt, along x.
const std::string text = R"({
  "schema_version": 1, "dimension": 2,
  "geometry": [{"name": "body", "type": "points", "points": [[0, 0]]}],
  "point_masses": [{"name": "mass", "at": {"nodes": [0]}, "mass": 2, "minimum": 1.2, "maximum": 3}],
  "springs": [{"name": "spring", "type": "grounded", "at": {"nodes": [0]}, "direction": [1, 0], "coefficients": [1]},
              {"name": "guide", "type": "grounded", "at": {"nodes": [0]}, "direction": [0, 1], "coefficients": [1]}],
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1, 0],
             "harmonics": [{"amplitude": 0.1}]}],
  "damping": {"mass_proportional": 0.1},
  "parameters": [{"name": "stiffness", "pointer": "/springs/0/coefficients/0", "minimum": 0.5, "maximum": 1.2}],
  "probes": [{"name": "bob", "at": {"nodes": [0]}}],
  "studies": [{"name": "space", "type": "design_space", "frequency": 1.2, "harmonics": 1, "samples": 8, "count": 50,
               "measures": [{"type": "total_mass"}, {"type": "path_length", "probe": "bob"}]}]
})";

std::shared_ptr<const DesignSpaceResult> run(const Scene& scene) {
  base::ExecutionContext context;
  const auto study = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "space");
  return std::dynamic_pointer_cast<const DesignSpaceResult>(study->run(context));
}

Scene sceneWith(const std::function<void(Json&)>& edit = {}) {
  Json json = Json::parse(text);
  if (edit) edit(json["studies"][0]);
  return Scene::parse(json.dump(), "/nowhere", "test.json");
}

double pathLengthOf(double mass, double stiffness) {
  return 0.4 / std::hypot(stiffness - mass * 1.44, 0.1 * mass * 1.2);
}

}  // namespace

class TestDesignSpaceStudies : public QObject {
  Q_OBJECT

 private slots:
  /// Both parameters of the scene, with the closed form of the motion.
  void samplesTheScenesParameters() {
    const auto result = run(sceneWith());
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    const Json summary = result->summary();
    QCOMPARE(summary["design_count"].get<int>(), 51);
    QCOMPARE(summary["share_without_motion"].get<double>(), 0.0);
    QVERIFY(summary["largest_residual"].get<double>() < 1e-7);
    double least = 1e9, most = 0;
    for (const auto& design : result->space.designs) {
      const double length = pathLengthOf(design.values[0], design.values[1]);
      QVERIFY(std::abs(design.amplitudes[0].pathLength - length) < 1e-5 * length);
      least = std::min(least, design.values[0]);
      most = std::max(most, design.values[0]);
    }
    QCOMPARE(summary["measures"][0]["name"].get<std::string>(), std::string("total mass"));
    QVERIFY(std::abs(summary["measures"][0]["smallest"].get<double>() - least) < 1e-12);
    QVERIFY(std::abs(summary["measures"][0]["largest"].get<double>() - most) < 1e-12);
    QVERIFY(least < 1.3 && most > 2.9);
    QCOMPARE(summary["measures"][0]["of_the_scene"].get<double>(), 2.0);
  }

  /// Here the lightest design swings farthest if it is stiff enough: the front is short, and nothing beats it.
  void tellsTheFront() {
    const auto result = run(sceneWith());
    const std::vector<int> front = result->front();
    QVERIFY(!front.empty());
    for (const int on : front)
      for (const auto& other : result->space.designs) {
        const auto& design = result->space.designs[static_cast<std::size_t>(on)];
        QVERIFY(
            !(other.values[0] < design.values[0] && other.amplitudes[0].pathLength > design.amplitudes[0].pathLength));
      }
    QCOMPARE(result->summary()["front"].size(), front.size());
  }

  void writesTablesAndCharts() {
    const Scene scene = sceneWith();
    const auto result = run(scene);
    QTemporaryDir directory;
    const std::filesystem::path folder = directory.path().toStdString();
    result->write(folder / "space");
    const scene::CsvTable designs(folder / "space/designs.csv"), paths(folder / "space/paths.csv");
    QCOMPARE(designs.size(), std::size_t(51));
    QCOMPARE(paths.size(), std::size_t(51 * 64));
    QCOMPARE(designs.text(0, "motion"), std::string_view("anew"));
    QCOMPARE(designs.number(5, "mass [kg]"), result->space.designs[5].values[0]);
    QCOMPARE(designs.number(5, "total mass [kg]"), result->space.designs[5].values[0]);
    double swing = 0;
    for (std::size_t row = 5 * 64; row < 6 * 64; ++row) swing = std::max(swing, paths.number(row, "bob x [m]"));
    QVERIFY(std::abs(4 * swing / designs.number(5, "bob path length [m]") - 1) < 2e-3);  // of 64 instants
    const auto charts = scene::resultCharts(scene, folder, {}, "displacement");
    QCOMPARE(charts.size(), std::size_t(2));
    QCOMPARE(charts[0].xLabel, std::string("Total mass [g]"));
    QCOMPARE(charts[0].series[0].x.size(), std::size_t(50));
    for (const auto& series : charts[0].series)
      for (std::size_t i = 0; i < series.x.size(); ++i)
        QCOMPARE(series.x[i],
                 1e3 * result->measures[0].of(result->space.designs[static_cast<std::size_t>(series.designs.at(i))]));
    QCOMPARE(charts[1].title, std::string("Paths of bob"));
    QCOMPARE(charts[1].series.back().group, 1);  // the scene's above the others
    QCOMPARE(charts[1].series.back().x.size(), std::size_t(65));
    QCOMPARE(charts[1].series.back().designs, std::vector<int>(65, 0));
  }

  void refusesUnknownParameters() {
    const Scene scene = sceneWith([](Json& study) { study["parameters"] = {"mess"}; });
    try {
      run(scene);
      QFAIL("nothing was refused");
    } catch (const base::InputError& error) {
      QCOMPARE(error.location(), std::string("test.json: /studies/0/parameters/0"));
    }
  }
};

QTEST_GUILESS_MAIN(TestDesignSpaceStudies)
#include "test_design_space_studies.moc"
