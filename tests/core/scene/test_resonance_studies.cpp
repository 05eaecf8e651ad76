#include <QTemporaryDir>
#include <QTest>
#include <numbers>

#include "core/base/error.hpp"
#include "core/harmonic/linear_modes.hpp"
#include "core/scene/designed_scene.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/sensitivity_tables.hpp"

using namespace pliant;
using scene::HarmonicResult;
using scene::Json;
using scene::Scene;

namespace {

/// Two masses on springs, of which the first is pushed: x'' m + c x' + k x + γ x³.
const std::string masses = R"({
  "schema_version": 1, "dimension": 1,
  "geometry": [{"name": "line", "type": "points", "points": [[0], [1]]}],
  "point_masses": [{"name": "first", "at": {"nodes": [0]}, "mass": 1, "minimum": 0.1, "maximum": 4},
                   {"name": "second", "at": {"nodes": [1]}, "mass": 1, "minimum": 0.1, "maximum": 4}],
  "springs": [{"name": "ground", "type": "grounded", "at": {"nodes": [0, 1]}, "direction": [1], "coefficients": [1, 0, 0.5]},
              {"name": "tie", "type": "between", "from": {"nodes": [0]}, "to": {"nodes": [1]}, "coefficients": [2]}],
  "damping": {"mass_proportional": 0.05},
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1],
             "harmonics": [{"amplitude": 0.1}]}],
  "probes": [{"name": "first", "at": {"nodes": [0]}}],
  "studies": [
    {"name": "response", "type": "frequency_response", "from": 0.5, "to": 3, "harmonics": 5, "samples": 32,
     "peak_sensitivity": true},
    {"name": "design", "type": "design", "frequency": 0.4, "harmonics": 5, "samples": 32,
     "objectives": [{"type": "resonance_avoidance", "frequency": 1, "half_width": 0.3},
                    {"type": "resonance_avoidance", "frequency": 2.2, "half_width": 0.2}]}]
})";

std::shared_ptr<const scene::Result> run(const Scene& scene, const std::string& study) {
  base::ExecutionContext context;
  auto result = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study)->run(context);
  if (result->termination != base::TerminationType::converged)
    QTest::qFail(result->message.c_str(), __FILE__, __LINE__);
  return result;
}

/// The scene with what its design study makes of it.
Scene designed(const Scene& scene, const std::string& study) {
  const auto result = std::dynamic_pointer_cast<const scene::DesignResult>(run(scene, study));
  return Scene::parse(scene::designedScene(scene, *result, result->after()).dump(), scene.directory(), "designed");
}

std::vector<harmonic::LinearMode> modesOf(const Scene& scene) {
  base::ExecutionContext context;
  return harmonic::computeLinearModes({scene::buildModel(scene), {1, 8}}, {}, context).modes;
}

Scene forkScene() { return Scene::load(PLIANT_SOURCE_DIR "/scenes/harmonic/fork_resonance.json"); }

}  // namespace

class TestResonanceStudies : public QObject {
  Q_OBJECT

 private slots:
  void aSweepFindsThePeakWhereItWasWanted();
  void theModeIsWhereItWasWanted();
  void bandsAreLeft();
  void peaksSensitivitiesAreWrittenAndRead();
  void goalsThatCannotBeMeantAreRefused();
  void drivesFasterThanTheHarmonicsAreWarnedOf();
};

void TestResonanceStudies::aSweepFindsThePeakWhereItWasWanted() {
  const Json summary = run(designed(forkScene(), "design"), "response")->summary();
  const double wanted = 1.5 * 2 * std::numbers::pi;
  QCOMPARE(summary["peak_count"].get<int>(), 1);
  QVERIFY(std::abs(summary["peaks"][0]["frequency"].get<double>() - wanted) < 2e-6 * wanted);
}

void TestResonanceStudies::theModeIsWhereItWasWanted() {
  const auto modes = modesOf(designed(forkScene(), "linear design"));
  const double wanted = 1.5 * 2 * std::numbers::pi;
  QVERIFY(std::abs(modes.at(0).omega - wanted) < 1e-6 * wanted);
}

void TestResonanceStudies::bandsAreLeft() {
  const Scene before = Scene::parse(masses, "/nowhere", "masses");
  QVERIFY(std::abs(modesOf(before).at(0).omega - 1) < 1e-9);
  const auto after = modesOf(designed(before, "design"));
  QCOMPARE(after.size(), std::size_t(2));
  for (const harmonic::LinearMode& mode : after) {
    QVERIFY2(std::abs(mode.omega - 1) > 0.29, qPrintable(QString::number(mode.omega)));
    QVERIFY2(std::abs(mode.omega - 2.2) > 0.19, qPrintable(QString::number(mode.omega)));
  }
}

void TestResonanceStudies::peaksSensitivitiesAreWrittenAndRead() {
  const Scene scene = Scene::parse(masses, "/nowhere", "masses");
  const auto result = std::dynamic_pointer_cast<const HarmonicResult>(run(scene, "response"));
  const Json summary = result->summary();
  QCOMPARE(summary["peaks"].size(), std::size_t(2));
  for (const Json& peak : summary["peaks"]) {
    QCOMPARE(peak["sensitivities"].size(), std::size_t(2));
    for (const Json& entry : peak["sensitivities"])  // both masses slow both resonances down
      QVERIFY(entry["frequency_derivative"].get<double>() < 0);
  }
  QTemporaryDir directory;
  const std::filesystem::path folder = directory.filePath("result").toStdString();
  result->write(folder);
  const auto read = HarmonicResult::read(scene, folder);
  QVERIFY(read->peakSensitivities != nullptr);
  QCOMPARE(scene::peakSensitivityTable(*read), scene::peakSensitivityTable(*result));
  QCOMPARE(read->summary()["peaks"].dump(), summary["peaks"].dump());
}

void TestResonanceStudies::goalsThatCannotBeMeantAreRefused() {
  const auto refusal = [](const Json& goal) -> QString {
    Json json = Json::parse(masses);
    json["studies"][1]["objectives"] = Json::array({goal});
    try {
      run(Scene::parse(json.dump(), "/nowhere", "masses"), "design");
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  };
  QVERIFY(refusal({{"type", "resonance_placement"}, {"frequency", 1}, {"probe", "nobody"}}).contains("nobody"));
  QVERIFY(refusal({{"type", "resonance_placement"}, {"frequency", 1}, {"probe", "first"}, {"from", 2}, {"to", 2}})
              .contains("range of frequencies is empty"));
  QVERIFY(!refusal({{"type", "resonance_placement"}, {"frequency", -1}, {"linear", true}}).isEmpty());
  QVERIFY(refusal({{"type", "resonance_placement"}, {"frequency", 1.2}, {"linear", true}}).isEmpty());
}

void TestResonanceStudies::drivesFasterThanTheHarmonicsAreWarnedOf() {
  Json json = Json::parse(masses);
  const auto warnings = [&](int order) {
    json["loads"][0]["harmonics"] = {{{"amplitude", 0.1}}, {{"order", order}, {"amplitude", 0.01}}};
    return run(Scene::parse(json.dump(), "/nowhere", "masses"), "response")->warnings();
  };
  QVERIFY(warnings(5).empty());
  QCOMPARE(warnings(6).size(), std::size_t(1));
  QVERIFY(QString::fromStdString(warnings(6)[0]).contains("6 times the frequency, but the motion has 5 harmonics"));
}

QTEST_GUILESS_MAIN(TestResonanceStudies)
#include "test_resonance_studies.moc"
