#include <QTemporaryDir>
#include <QTest>

#include "core/base/error.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/modes_result.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using scene::Json;

namespace {

/// Two masses between walls on a line: ω² = k/m and 3 k/m.
const char* const twoMasses = R"({
  "schema_version": 1,
  "dimension": 1,
  "geometry": [{"name": "row", "type": "points", "points": [[1], [2]]}],
  "point_masses": [{"name": "bobs", "at": {"nodes": [0, 1]}, "mass": 0.5}],
  "springs": [
    {"name": "left", "type": "anchored", "at": {"nodes": [0]}, "anchor": [0], "coefficients": [8, 0, 20]},
    {"name": "middle", "type": "between", "from": {"nodes": [0]}, "to": {"nodes": [1]}, "coefficients": [8]},
    {"name": "right", "type": "anchored", "at": {"nodes": [1]}, "anchor": [3], "coefficients": [8, 0, 20]}
  ],
  "damping": {"mass_proportional": 0.2, "stiffness_proportional": 0.01},
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1],
             "harmonics": [{"amplitude": 0.3}]}],
  "probes": [{"name": "first", "at": {"nodes": [0]}}],
  "studies": [{"name": "modes", "type": "linear_modes", "count": 2},
              {"name": "linear", "type": "linear_response", "from": 2, "to": 10, "points": 30}]
})";

std::shared_ptr<const scene::Result> run(const scene::Scene& scene, const std::string& study) {
  base::ExecutionContext context;
  return scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study)->run(context);
}

}  // namespace

class TestLinearStudies : public QObject {
  Q_OBJECT

 private slots:
  void modesAreWritten() {
    const auto result = run(test::parse(twoMasses), "modes");
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    const QTemporaryDir folder;
    const std::filesystem::path place = folder.filePath("modes").toStdString();
    result->write(place);
    const Json summary = scene::parseJson(scene::readTextFile(place / "summary.json"));
    QCOMPARE(summary["kind"].get<std::string>(), std::string("modes"));
    QCOMPARE(summary["mode_count"].get<int>(), 2);
    for (const int i : {0, 1}) {
      const double omega = std::sqrt(16.0 * (2 * i + 1));
      const Json& mode = summary["modes"][i];
      QVERIFY(std::abs(mode["frequency"].get<double>() - omega) < 1e-12 * omega);
      QVERIFY(std::abs(mode["frequency_hz"].get<double>() - omega / 6.283185307179586) < 1e-12 * omega);
      QVERIFY(std::abs(mode["damping_ratio"].get<double>() - 0.5 * (0.2 / omega + 0.01 * omega)) < 1e-12);
    }
    const std::string table = scene::readTextFile(place / "modes.csv");
    const auto rows = scene::readCsv(table);
    QCOMPARE(rows.size(), std::size_t(2));
    QVERIFY(std::abs(scene::csvNumber(rows[1][2]) - 2) < 1e-12);
    QVERIFY(std::abs(scene::csvNumber(rows[0][3]) - 1) < 1e-12);  // (1, 1)/√(2 m) with m = 0.5 kg
    QVERIFY(std::abs(scene::csvNumber(rows[0][4]) + scene::csvNumber(rows[1][4])) < 1e-12);
  }

  void aModeIsAMotionAboutTheEquilibrium() {
    const auto result = std::dynamic_pointer_cast<const scene::ModesResult>(run(test::parse(twoMasses), "modes"));
    QVERIFY(result);
    const mechanics::Vector z = result->motion(1, 0.1);
    const mechanics::Vector at = result->problem->configurationAt(z, 0.5);
    const double reach = 0.1 * std::sin(0.5);
    QVERIFY(std::abs(std::abs(at[0] - 1) - reach) < 1e-12);
    QVERIFY(std::abs((at[0] - 1) + (at[1] - 2)) < 1e-12);
  }

  void modesAreNoHarmonicResult() {
    const scene::Scene scene = test::parse(twoMasses);
    const QTemporaryDir folder;
    const std::filesystem::path place = folder.filePath("modes").toStdString();
    run(scene, "modes")->write(place);
    QVERIFY_EXCEPTION_THROWN(scene::HarmonicResult::read(scene, place), base::InputError);
  }

  /// Both modes are driven; with some 5 % of critical damping the peaks are within 2 % of the natural frequencies.
  void linearResponseIsAHarmonicResult() {
    const scene::Scene scene = test::parse(twoMasses);
    const auto result = run(scene, "linear");
    const Json summary = result->summary();
    QCOMPARE(summary["type"].get<std::string>(), std::string("linear_response"));
    QCOMPARE(summary["peak_count"].get<int>(), 2);
    QVERIFY(std::abs(summary["peaks"][0]["frequency"].get<double>() - 4) < 0.08);
    QVERIFY(std::abs(summary["peaks"][1]["frequency"].get<double>() - std::sqrt(48)) < 0.14);
    const QTemporaryDir folder;
    const std::filesystem::path place = folder.filePath("linear").toStdString();
    result->write(place);
    const auto back = scene::HarmonicResult::read(scene, place);
    const auto& first = dynamic_cast<const scene::HarmonicResult&>(*result);
    QVERIFY(back->isCurve && back->isLinear && first.isCurve && first.isLinear);
    QCOMPARE(back->points.size(), first.points.size());
    for (std::size_t i = 0; i < first.points.size(); ++i) QVERIFY(back->points[i].z == first.points[i].z);
  }
};

QTEST_GUILESS_MAIN(TestLinearStudies)
#include "test_linear_studies.moc"
