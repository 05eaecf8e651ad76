#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <numbers>
#include <random>

#include "core/base/error.hpp"
#include "core/scene/calibration_result.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/measurement_file.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/result_charts.hpp"

using namespace pliant;
using scene::CalibrationStudyResult;
using scene::Json;
using scene::Scene;

namespace {

/// m x'' + α m x' + x = F cos ωt along x of the second of two nodes, which rests at x = 2; the first stands still.
const std::string text = R"({
  "schema_version": 1, "dimension": 2,
  "geometry": [{"name": "body", "type": "points", "points": [[0, 0], [2, 0]]}],
  "point_masses": [{"name": "bob", "at": {"nodes": [1]}, "mass": 0.9, "minimum": 0.2, "maximum": 3}],
  "springs": [{"name": "spring", "type": "grounded", "at": {"nodes": [1]}, "direction": [1, 0], "coefficients": [1]}],
  "boundary_conditions": [
    {"name": "wall", "type": "locked", "at": {"nodes": [0]}},
    {"name": "rail", "type": "locked", "at": {"nodes": [1]}, "coordinates": ["y"]}],
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"nodes": [1]}, "direction": [1, 0],
             "harmonics": [{"amplitude": 0.1}]}],
  "damping": {"mass_proportional": 0.5},
  "parameters": [{"name": "damping", "pointer": "/damping/mass_proportional", "minimum": 0.01, "maximum": 1}],
  "probes": [{"name": "left eye", "at": {"nodes": [0]}}, {"name": "bob", "at": {"nodes": [1]}}],
  "studies": [{"name": "fit", "type": "calibration", "harmonics": 1, "samples": 8, "parameters": ["bob", "damping"],
               "measurements": [{"file": "slow.csv", "frequency": 0.8}, {"file": "fast.csv", "frequency": 1.2}]}]
})";

/// The oscillator's place by its closed form, with mass 1.3 and damping 0.2.
double placeAt(double omega, double time) {
  const double a = 1 - 1.3 * omega * omega, b = 0.2 * 1.3 * omega;
  return 2 + 0.1 * (a * std::cos(omega * time) + b * std::sin(omega * time)) / (a * a + b * b);
}

std::string seen(double omega, double offset, double deviation, double perMillimetre = 1) {
  std::mt19937 random(7);
  std::normal_distribution<double> error(0, deviation);
  std::string table = "# seen by nobody\r\ntime [ms], bob x [mm] ,left eye y [mm]\r\n";
  for (int i = 0; i < 50; ++i) {
    const double time = 0.2 * i;
    table += std::to_string(1e3 * time) + "," +
             (i == 7 ? "" : std::to_string(perMillimetre * 1e3 * (placeAt(omega, time + offset) + error(random)))) +
             "," + std::to_string(1e3 * error(random)) + "\r\n";
  }
  return table + "\r\n";
}

}  // namespace

class TestCalibrationStudies : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    write("slow.csv", seen(0.8, 0.4, 0.002));
    write("fast.csv", seen(1.2, 1.9, 0.002));
  }
  void findsMassAndDamping();
  void takesAxesAndClocks();
  void saysWhatIsNotDetermined();
  void warnsOfBoundsAndPatterns();
  void writesTablesAndCharts();
  void refusesWrongTables_data();
  void refusesWrongTables();
  void refusesWrongInput();
  void theHashKnowsTheMeasurements();
  void keepsWhatItHasWhenCancelled();

 private:
  void write(const char* name, const std::string& content) {
    scene::writeTextFile(directory_.filePath(name).toStdString(), content);
  }
  Scene sceneWith(const std::function<void(Json&)>& edit = {}) const {
    Json json = Json::parse(text);
    if (edit) edit(json);
    return Scene::parse(json.dump(), directory_.path().toStdString(), "test.json");
  }
  static std::shared_ptr<const CalibrationStudyResult> run(const Scene& scene) {
    base::ExecutionContext context;
    const auto study = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "fit");
    return std::dynamic_pointer_cast<const CalibrationStudyResult>(study->run(context));
  }
  QTemporaryDir directory_;
};

void TestCalibrationStudies::findsMassAndDamping() {
  const auto result = run(sceneWith());
  QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
  const Json summary = result->summary();
  const std::array<double, 2> truth{1.3, 0.2};
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& parameter = summary["parameters"][i];
    QVERIFY(parameter["lower"].get<double>() < truth[i] && truth[i] < parameter["upper"].get<double>());
    QVERIFY(parameter["standard_error"].get<double>() < 0.02);
    QVERIFY(parameter["at_bound"].is_null());
  }
  QCOMPARE(summary["sample_count"].get<int>(), 4 * 50 - 2);
  QCOMPARE(summary["degrees_of_freedom"].get<int>(), 4 * 50 - 2 - 4);
  QVERIFY(std::abs(summary["residual_standard_deviation"].get<double>() / 0.002 - 1) < 5 / std::sqrt(2 * 194.0));
  QVERIFY(std::abs(summary["measurements"][0]["time_offset"].get<double>() - 0.4) < 0.05);
  QVERIFY(std::abs(summary["measurements"][1]["time_offset"].get<double>() - 1.9) < 0.05);
  QCOMPARE(summary["measurements"][1]["stability"].get<std::string>(), std::string("stable"));
  QVERIFY(summary["warnings"].empty() && summary["undetermined_count"] == 0);
  QVERIFY(summary["root_mean_square"] < summary["root_mean_square_before"]);
  // A higher level makes wider intervals, about by the ratio of the normal distribution's quantiles.
  const Json wide = run(sceneWith([](Json& json) { json["studies"][0]["confidence"] = 0.99; }))->summary();
  const auto width = [](const Json& json) {
    return json["parameters"][0]["upper"].get<double>() - json["parameters"][0]["lower"].get<double>();
  };
  QVERIFY(std::abs(width(wide) / width(summary) - 2.601 / 1.972) < 2e-3);  // Student's t of 194 degrees of freedom
}

void TestCalibrationStudies::takesAxesAndClocks() {
  const auto result = run(sceneWith([](Json& json) {
    for (Json& measurement : json["studies"][0]["measurements"]) measurement["axes"] = {"x"};
    json["studies"][0]["measurements"][0]["time_offset"] = 0.4;
    json["studies"][0]["measurements"][1]["values"] = "swings";
  }));
  const Json summary = result->summary();
  QCOMPARE(summary["sample_count"].get<int>(), 2 * 49);
  QCOMPARE(summary["degrees_of_freedom"].get<int>(), 2 * 49 - 4);  // two parameters, one offset, one place
  QCOMPARE(summary["measurements"][0]["time_offset"].get<double>(), 0.4);
  QVERIFY(std::abs(summary["parameters"][0]["value"].get<double>() - 1.3) < 0.05);
}

void TestCalibrationStudies::saysWhatIsNotDetermined() {
  const auto result = run(sceneWith([](Json& json) { json["studies"][0]["measurements"].erase(1); }));
  const Json summary = result->summary();
  QCOMPARE(summary["undetermined_count"].get<int>(), 1);
  QVERIFY(summary["parameters"][0]["standard_error"].is_null() && summary["parameters"][1]["lower"].is_null());
  const std::string sentence = summary["undetermined"][0];
  QVERIFY2(sentence.starts_with("The parameters \"bob\", \"damping\" cannot be told apart"), sentence.c_str());
  QCOMPARE(result->warnings().front(), sentence);
}

/// With a bound below the true mass, and a measured motion that is not what the model could do.
void TestCalibrationStudies::warnsOfBoundsAndPatterns() {
  write("fast.csv", seen(1.2, 1.9, 1e-4, 1.1));
  const auto result = run(sceneWith([](Json& json) { json["point_masses"][0]["maximum"] = 1.1; }));
  const Json summary = result->summary();
  QCOMPARE(summary["parameters"][0]["value"].get<double>(), 1.1);
  QCOMPARE(summary["parameters"][0]["at_bound"].get<std::string>(), std::string("maximum"));
  QVERIFY(summary["parameters"][0]["lower"].is_null());
  const auto warnings = result->warnings();
  const auto says = [&](const std::string& what) {
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const std::string& warning) { return warning.find(what) != std::string::npos; });
  };
  QVERIFY(says("stands at its maximum") && says("is not noise"));
}

void TestCalibrationStudies::writesTablesAndCharts() {
  const Scene scene = sceneWith();
  const auto result = run(scene);
  const std::filesystem::path folder = directory_.filePath("results").toStdString();
  result->write(folder / "fit");
  const scene::CsvTable parameters(folder / "fit/parameters.csv"), measured(folder / "fit/measured.csv"),
      fitted(folder / "fit/fitted.csv"), correlation(folder / "fit/correlation.csv");
  QCOMPARE(parameters.number(0, "value"), result->calibration.history.back().values[0]);
  QCOMPARE(measured.size(), std::size_t(198));
  QCOMPARE(correlation.number(0, "bob"), 1.0);
  QCOMPARE(correlation.number(1, "bob"), correlation.number(0, "damping"));
  QVERIFY(std::abs(measured.number(0, "measured [m]") - placeAt(0.8, 0.4)) < 0.01);
  // The fitted curve runs through the fitted values, which are near the true motion.
  const double omega = 0.8, tau = measured.number(20, "omega t [rad]");
  QVERIFY(std::abs(std::remainder(tau - omega * (measured.number(20, "time [s]") + 0.4), 2 * std::numbers::pi)) < 0.05);
  const double row = tau / (2 * std::numbers::pi) * 128;
  const auto below = static_cast<std::size_t>(row);
  const double interpolated = (1 - (row - std::floor(row))) * fitted.number(below, "fitted [m]") +
                              (row - std::floor(row)) * fitted.number(below + 1, "fitted [m]");
  QVERIFY(std::abs(interpolated - measured.number(20, "fitted [m]")) < 1e-3);

  const auto charts = scene::resultCharts(scene, folder, {}, "displacement");
  QCOMPARE(charts.size(), std::size_t(2));
  QCOMPARE(charts[0].series.size(), std::size_t(6));  // measured, fitted and before of two coordinates
  QCOMPARE(charts[0].series[0].name, std::string("bob x"));
  QCOMPARE(charts[0].series[0].group, charts[0].series[2].group);
  QVERIFY(charts[0].series[0].group != charts[0].series[3].group);
  QCOMPARE(charts[1].series[3].x.size(), std::size_t(50));
  QVERIFY(charts[1].title.starts_with("fast.csv, "));
}

void TestCalibrationStudies::refusesWrongTables_data() {
  QTest::addColumn<QString>("table");
  QTest::addColumn<int>("line");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("empty") << "" << 1 << "The table is empty";
  QTest::newRow("no rows") << "time [s],bob x [m]\n" << 1 << "The table has no rows.";
  QTest::newRow("no time") << "bob x [m]\n1\n" << 1 << "Expected one column \"time [s]\", but found 0.";
  QTest::newRow("no unit") << "time,bob x [m]\n1\n" << 1 << "The column \"time\" has no unit in square brackets";
  QTest::newRow("wrong unit") << "time [s],bob x [kg]\n" << 1 << "The column \"bob x [kg]\" has a wrong unit";
  QTest::newRow("no probe") << "time [s],bop x [m]\n" << 1 << "The column \"bop x [m]\" is neither";
  QTest::newRow("no axis") << "time [s],bob z [m]\n" << 1 << "The column \"bob z [m]\" is neither";
  QTest::newRow("twice") << "time [s],bob x [m],bob x [mm]\n" << 1 << "The columns \"bob x [m]\" and \"bob x [mm]\"";
  QTest::newRow("nothing counts") << "time [s],bob y [m]\n"
                                  << 1 << "The table has no column of a coordinate that counts";
  QTest::newRow("short row") << "time [s],bob x [m]\n0,1\n\n# pause\n1\n"
                             << 5 << "This row has 1 cells, but the header has 2.";
  QTest::newRow("no number") << "time [s],bob x [m]\n0,1\n1,one\n" << 3 << "\"one\" is no finite number.";
  QTest::newRow("infinity") << "time [s],bob x [m]\n0,inf\n" << 2 << "\"inf\" is no finite number.";
  QTest::newRow("no instant") << "time [s],bob x [m]\n0,1\n,2\n" << 3 << "This row has no time.";
  QTest::newRow("nothing seen") << "time [s],bob x [m]\n0,\n1,\n" << 3 << "The column \"bob x [m]\" has no values.";
}

void TestCalibrationStudies::refusesWrongTables() {
  QFETCH(QString, table);
  QFETCH(int, line);
  QFETCH(QString, sentence);
  write("slow.csv", table.toStdString());
  const Scene scene = sceneWith([](Json& json) { json["studies"][0]["measurements"][0]["axes"] = {"x"}; });
  try {
    run(scene);
    QFAIL("It was read.");
  } catch (const base::InputError& error) {
    QCOMPARE(error.location(), directory_.filePath("slow.csv").toStdString() + ":" + std::to_string(line));
    QVERIFY2(error.problem().starts_with(sentence.toStdString()), error.problem().c_str());
  }
}

void TestCalibrationStudies::refusesWrongInput() {
  const auto refusal = [&](const std::function<void(Json&)>& edit) {
    try {
      run(sceneWith(edit));
    } catch (const base::InputError& error) {
      return error.location() + ": " + error.problem();
    }
    return std::string();
  };
  const std::string unknown = refusal([](Json& json) { json["studies"][0]["parameters"] = {"bob", "bop"}; });
  QVERIFY2(unknown.starts_with("test.json: /studies/0/parameters/1: There is no point mass"), unknown.c_str());
  const std::string missing =
      refusal([](Json& json) { json["studies"][0]["measurements"][0]["file"] = "nothing.csv"; });
  QVERIFY2(missing.find("nothing.csv") != std::string::npos, missing.c_str());
  write("slow.csv", "time [s],bob x [m]\n0,2.1\n1,2\n2,1.9\n");
  const std::string few = refusal([](Json& json) { json["studies"][0]["measurements"].erase(1); });
  QVERIFY2(few.starts_with("test.json: /studies/0: 3 measured values are too few for 3 unknowns"), few.c_str());
}

void TestCalibrationStudies::theHashKnowsTheMeasurements() {
  const std::string before = scene::hashScene(sceneWith());
  write("fast.csv", seen(1.2, 1.9, 0.001));
  QVERIFY(scene::hashScene(sceneWith()) != before);
}

void TestCalibrationStudies::keepsWhatItHasWhenCancelled() {
  const Scene scene = sceneWith();
  base::ExecutionContext* running = nullptr;
  base::ExecutionContext context([&](double fraction, const std::string&) {
    if (fraction > 0) running->requestCancel();
  });
  running = &context;
  const auto study = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "fit");
  const auto result = study->run(context);
  QVERIFY(result->termination == base::TerminationType::cancelled);
  const Json summary = result->summary();
  QVERIFY(summary["root_mean_square"] < summary["root_mean_square_before"]);
  QVERIFY(summary["parameters"][0]["standard_error"].is_number());
}

QTEST_GUILESS_MAIN(TestCalibrationStudies)
#include "test_calibration_studies.moc"
