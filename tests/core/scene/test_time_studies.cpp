#include <QTemporaryDir>
#include <QTest>

#include "core/base/error.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using scene::Json;

namespace {

const std::string oscillator = R"({
  "schema_version": 1,
  "dimension": 1,
  "geometry": [{"name": "place", "type": "points", "points": [[0]]}],
  "point_masses": [{"name": "bob", "at": {"nodes": [0]}, "mass": 1}],
  "springs": [{"name": "spring", "type": "grounded", "at": {"nodes": [0]}, "direction": [1], "coefficients": [1, 0, 0.5]}],
  "damping": {"mass_proportional": 0.3},
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1],
             "harmonics": [{"amplitude": 0.1}]}],
  "probes": [{"name": "bob", "at": {"nodes": [0]}}],
  "studies": [
    {"name": "motion", "type": "periodic_motion", "frequency": 0.8, "harmonics": 15},
    {"name": "time", "type": "time_integration", "frequency": 0.8, "steps_per_period": 512},
    {"name": "comparison", "type": "comparison", "frequency": 0.8, "harmonic_counts": [1, 3, 9], "steps_per_period": [256, 512]}
  ]
})";

std::shared_ptr<const scene::Result> run(const scene::Scene& scene, const std::string& study) {
  base::ExecutionContext context;
  return scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study)->run(context);
}

}  // namespace

class TestTimeStudies : public QObject {
  Q_OBJECT

 private slots:
  void timeIntegrationIsWritten() {
    const scene::Scene scene = test::parse(oscillator);
    const auto result = run(scene, "time");
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    const QTemporaryDir folder;
    const std::filesystem::path place = folder.filePath("time").toStdString();
    result->write(place);
    const Json summary = scene::parseJson(scene::readTextFile(place / "summary.json"));
    const Json balance = run(scene, "motion")->summary();
    for (const char* key : {"path_length", "maximum_displacement"}) {
      const double expected = balance["probes"][0][key], found = summary["probes"][0][key];
      QVERIFY2(std::abs(found - expected) < 1e-4 * expected, key);
    }
    const std::string trajectories = scene::readTextFile(place / "trajectories.csv");
    QCOMPARE(scene::readCsv(trajectories).size(), std::size_t(512));
    const std::string periods = scene::readTextFile(place / "periods.csv");
    const auto rows = scene::readCsv(periods);
    QCOMPARE(static_cast<int>(rows.size()), summary["period_count"].get<int>());
    QCOMPARE(scene::csvNumber(rows.back()[1]), summary["difference"].get<double>());
  }

  void comparisonIsWritten() {
    const auto result = run(test::parse(oscillator), "comparison");
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    const QTemporaryDir folder;
    const std::filesystem::path place = folder.filePath("comparison").toStdString();
    result->write(place);
    const Json summary = scene::parseJson(scene::readTextFile(place / "summary.json"));
    QCOMPARE(summary["harmonics"].size(), std::size_t(3));
    QCOMPARE(summary["steps"].size(), std::size_t(2));
    QCOMPARE(summary["samples"].size(), std::size_t(2));
    const std::string table = scene::readTextFile(place / "harmonics.csv");
    const auto rows = scene::readCsv(table);
    QCOMPARE(rows.size(), std::size_t(3));
    for (std::size_t i = 0; i < 3; ++i)
      QCOMPARE(scene::csvNumber(rows[i][5]), summary["harmonics"][i]["relative_difference_to_reference"].get<double>());
    QVERIFY(scene::csvNumber(rows[1][5]) < 0.1 * scene::csvNumber(rows[0][5]));
    QVERIFY(scene::csvNumber(rows[2][5]) < 0.1 * scene::csvNumber(rows[1][5]));
  }

  void stepsWithoutCommonTimesAreRefused() {
    std::string text = oscillator;
    text.replace(text.find("[256, 512]"), 10, "[256, 384]");
    const scene::Scene scene = test::parse(text);
    try {
      run(scene, "comparison");
      QFAIL("refused nothing");
    } catch (const base::InputError& error) {
      QVERIFY2(QString(error.what()).contains("/studies/2/steps_per_period"), error.what());
    }
  }
};

QTEST_GUILESS_MAIN(TestTimeStudies)
#include "test_time_studies.moc"
