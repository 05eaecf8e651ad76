#include <QFloat16>  // comparing JSON asks about every type that Qt can compare
#include <QTemporaryDir>
#include <QTest>
#include <complex>
#include <map>

#include "core/base/error.hpp"
#include "core/scene/expected_values.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using scene::HarmonicResult;
using scene::Json;
using scene::Scene;
namespace fs = std::filesystem;

class TestStudies : public QObject {
  Q_OBJECT

  /// m x'' + c x' + k x = F cos τ on a line, with a second mass that can be locked away.
  static Scene oscillator() {
    return test::parse(R"({"schema_version": 1, "dimension": 1,
      "geometry": [{"name": "p", "type": "points", "points": [[0.5]]}],
      "point_masses": [{"name": "bob", "at": {"nodes": [0]}, "mass": 2}],
      "springs": [{"name": "k", "type": "grounded", "at": {"nodes": [0]}, "direction": [1], "coefficients": [50]}],
      "damping": {"mass_proportional": 0.3, "stiffness_proportional": 0.01},
      "loads": [{"name": "F", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1],
                 "harmonics": [{"amplitude": 4}]}],
      "probes": [{"name": "bob", "at": {"nodes": [0]}}],
      "studies": [{"name": "motion", "type": "periodic_motion", "frequency": 4, "harmonics": 3},
                  {"name": "response", "type": "frequency_response", "from": 2, "to": 8, "harmonics": 2}],
      "expected": [{"study": "motion", "pointer": "/probes/0/maximum_displacement", "value": 0.2, "tolerance": 0.1},
                   {"study": "motion", "pointer": "/probes/1/maximum_displacement", "value": 0.2, "tolerance": 0.1},
                   {"study": "response", "pointer": "/peak_count", "value": 1, "tolerance": 0}]})");
  }

  static std::shared_ptr<const HarmonicResult> run(const Scene& scene, const char* study,
                                                   const scene::ResultObserver& observe = {}) {
    base::ExecutionContext context;
    const auto result =
        scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study)->run(context, observe);
    return std::dynamic_pointer_cast<const HarmonicResult>(result);
  }

  /// The linear oscillator's motion is the real part of this times e^{iτ}, for a mass m.
  static std::complex<double> closedForm(double omega, double mass = 2) {
    return 4.0 / std::complex<double>(50 - mass * omega * omega, omega * (0.3 * mass + 0.01 * 50));
  }

  static std::map<std::string, std::string> filesIn(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
      files[entry.path().filename().string()] = scene::readTextFile(entry.path());
    return files;
  }

  static void compare(const HarmonicResult& a, const HarmonicResult& b) {
    QCOMPARE(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) {
      const auto &p = a.points[i], &q = b.points[i];
      QVERIFY(p.kind == q.kind && p.probe == q.probe && p.omega == q.omega && p.arcLength == q.arcLength);
      QVERIFY(p.z == q.z && p.residual == q.residual && p.newtonIterations == q.newtonIterations);
      QCOMPARE(p.amplitudes.size(), q.amplitudes.size());
      for (std::size_t k = 0; k < p.amplitudes.size(); ++k)
        QVERIFY(p.amplitudes[k].pathLength == q.amplitudes[k].pathLength &&
                p.amplitudes[k].maximumDisplacement == q.amplitudes[k].maximumDisplacement);
    }
    QVERIFY(a.termination == b.termination && a.message == b.message && a.isCurve == b.isCurve);
    QCOMPARE(a.problem->basis().samples(), b.problem->basis().samples());
  }

 private slots:
  void theMotionOfALinearOscillatorIsTheClosedForm() {
    const auto result = run(oscillator(), "motion");
    const Json summary = result->summary();
    QCOMPARE(summary["termination"], Json("converged"));
    const Eigen::VectorXd& z = result->points[0].z;
    QVERIFY(std::abs(std::complex(z[2], -z[1]) - closedForm(4)) < 1e-9);
    QVERIFY(std::abs(z[0] - 0.5) < 1e-12);
    QVERIFY(std::abs(summary["probes"][0]["path_length"].get<double>() - 4 * std::abs(closedForm(4))) < 1e-9);
    QVERIFY(std::abs(summary["probes"][0]["maximum_displacement"].get<double>() - std::abs(closedForm(4))) < 1e-9);
  }

  void theSensitivityIsTheDerivativeOfTheClosedForm() {
    const Json summary = run(oscillator(), "motion")->summary();
    const double derivative = summary["probes"][0]["sensitivities"][0]["path_length_derivative"];
    const double h = 1e-4, expected = 4 * (std::abs(closedForm(4, 2 + h)) - std::abs(closedForm(4, 2 - h))) / (2 * h);
    QVERIFY(std::abs(derivative - expected) < 1e-6 * std::abs(expected));
  }

  void theResonancePeakIsTheClosedForm() {
    const Json summary = run(oscillator(), "response")->summary();
    QCOMPARE(summary["fold_count"], Json(0));
    QCOMPARE(summary["peak_count"], Json(1));
    // |k - m ω² + i c ω|² is least at ω² = k/m - c²/(2 m²).
    const double damping = 0.3 * 2 + 0.01 * 50, expected = std::sqrt(50.0 / 2 - damping * damping / (2 * 2 * 2));
    QVERIFY(std::abs(summary["peaks"][0]["frequency"].get<double>() - expected) < 1e-6 * expected);
    QVERIFY(std::abs(summary["peaks"][0]["path_length"].get<double>() - 4 * std::abs(closedForm(expected))) < 1e-8);
    QVERIFY(std::abs(summary["last_frequency"].get<double>() - 8) < 1e-12);
  }

  void whatIsWrittenIsReadBack_data() {
    QTest::addColumn<QString>("study");
    QTest::newRow("motion") << "motion";
    QTest::newRow("response") << "response";
  }
  void whatIsWrittenIsReadBack() {
    QFETCH(QString, study);
    const QTemporaryDir folder;
    const fs::path directory = fs::path(folder.path().toStdString()) / "deep" / "result";
    const auto written = run(oscillator(), qPrintable(study));
    written->write(directory);
    const auto read = HarmonicResult::read(oscillator(), directory);
    compare(*written, *read);
    QCOMPARE(read->provenance.sceneHash, written->provenance.sceneHash);
    QCOMPARE(read->provenance.study, study.toStdString());
    if (written->sensitivity)
      QVERIFY((written->sensitivity->derivative() - read->sensitivity->derivative()).norm() <
              1e-9 * written->sensitivity->derivative().norm());
    QCOMPARE(std::distance(fs::directory_iterator(directory.parent_path()), {}), 1);
  }

  void aResultBringsItsParameters() {
    const QTemporaryDir folder;
    const fs::path directory = fs::path(folder.path().toStdString()) / "result";
    run(oscillator().withValue("/point_masses/0/mass", 3), "motion")->write(directory);
    const auto read = HarmonicResult::read(oscillator(), directory);
    QCOMPARE(read->problem->model().pointMasses[0].mass, 3.0);
  }

  void twoRunsGiveEqualBytes() {
    const QTemporaryDir folder;
    const fs::path directory = folder.path().toStdString();
    for (const char* study : {"motion", "response"}) {
      run(oscillator(), study)->write(directory / "a");
      run(oscillator(), study)->write(directory / "b");
      auto a = filesIn(directory / "a"), b = filesIn(directory / "b");
      for (auto* files : {&a, &b}) {
        Json summary = scene::parseJson((*files)["summary.json"]);
        summary.erase("seconds");
        summary["provenance"].erase("date");
        (*files)["summary.json"] = summary.dump();
      }
      QVERIFY(a == b);
      QVERIFY(a.size() >= 4);
    }
  }

  void anOlderResultIsReplacedAndNothingElse() {
    const QTemporaryDir folder;
    const fs::path directory = folder.path().toStdString();
    const auto result = run(oscillator(), "motion");
    result->write(directory / "a");
    scene::writeTextFile(directory / "a" / "stale.csv", "1");
    result->write(directory / "a");
    QVERIFY(!fs::exists(directory / "a" / "stale.csv"));
    fs::create_directory(directory / "precious");
    scene::writeTextFile(directory / "precious" / "thesis.tex", "1");
    QVERIFY_EXCEPTION_THROWN(result->write(directory / "precious"), base::InputError);
    QVERIFY(fs::exists(directory / "precious" / "thesis.tex"));
    QVERIFY_EXCEPTION_THROWN(result->write(directory / "a" / "summary.json"), base::InputError);
  }

  void resultsOfOtherScenesAndDamagedOnesAreRefused() {
    const QTemporaryDir folder;
    const fs::path directory = fs::path(folder.path().toStdString()) / "a";
    run(oscillator(), "motion")->write(directory);
    QVERIFY_EXCEPTION_THROWN(HarmonicResult::read(test::parse(test::fullScene), directory), base::InputError);
    const auto files = filesIn(directory);
    for (const char* name : {"summary.json", "response.csv", "coefficients.csv"}) {
      for (const std::size_t length : {std::size_t{0}, files.at(name).size() / 2}) {
        scene::writeTextFile(directory / name, files.at(name).substr(0, length));
        QVERIFY_EXCEPTION_THROWN(HarmonicResult::read(oscillator(), directory), base::InputError);
      }
      fs::remove(directory / name);
      QVERIFY_EXCEPTION_THROWN(HarmonicResult::read(oscillator(), directory), base::InputError);
      scene::writeTextFile(directory / name, files.at(name));
    }
    HarmonicResult::read(oscillator(), directory);
  }

  void snapshotsShareTheirPoints() {
    std::vector<std::shared_ptr<const scene::Result>> snapshots;
    const auto result = run(oscillator(), "response", [&](auto snapshot) { snapshots.push_back(std::move(snapshot)); });
    QVERIFY(!snapshots.empty());
    for (const auto& snapshot : snapshots) {
      const auto& curve = dynamic_cast<const HarmonicResult&>(*snapshot);
      QVERIFY(curve.points.size() <= result->points.size());
      for (std::size_t i = 0; i < curve.points.size(); ++i) QCOMPARE(&curve.points[i], &result->points[i]);
    }
    QCOMPARE(dynamic_cast<const HarmonicResult&>(*snapshots.back()).points.size(), result->points.size());
  }

  void aCancelledCurveKeepsWhatItHas() {
    const Scene scene = oscillator();
    const QTemporaryDir folder;
    const fs::path directory = fs::path(folder.path().toStdString()) / "a";
    int calls = 0;
    base::ExecutionContext* running = nullptr;
    base::ExecutionContext context([&](double, const std::string&) {
      if (++calls == 10) running->requestCancel();
    });
    running = &context;
    const auto result =
        scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "response")->run(context);
    QVERIFY(result->termination == base::TerminationType::cancelled);
    result->write(directory);
    const auto read = HarmonicResult::read(scene, directory);
    QVERIFY(read->termination == base::TerminationType::cancelled);
    QVERIFY(read->points.size() > 2 && read->points.back().omega < 8);
    QVERIFY(!read->message.empty());
  }

  void adaptiveHarmonicsRiseUntilEnough() {
    const Scene duffing = Scene::load(fs::path(PLIANT_SOURCE_DIR) / "scenes/harmonic/duffing.json");
    const Scene scene = duffing.withValue("/studies/0", Json{{"name", "motion"},
                                                             {"type", "periodic_motion"},
                                                             {"frequency", 1},
                                                             {"harmonics", 1},
                                                             {"harmonics_tolerance", 1e-6}});
    const auto result = run(scene, "motion");
    QVERIFY(result->termination == base::TerminationType::converged);
    QVERIFY(result->problem->basis().harmonics() >= 5);
    QCOMPARE(result->summary()["harmonics"].get<int>(), result->problem->basis().harmonics());
  }

  void harmonicsPerNodeAreKeptWithTheResult() {
    const QTemporaryDir folder;
    const fs::path directory = fs::path(folder.path().toStdString()) / "result";
    const Scene scene = test::parse(test::fullScene)
                            .withValue("/studies/0/harmonics", 1)
                            .withValue("/studies/0/harmonics_tolerance", 1e-4)
                            .withValue("/studies/0/harmonics_of", "node");
    const auto result = run(scene, "motion");
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    QVERIFY(result->leftOut && *result->leftOut <= 1e-4);
    QVERIFY(result->problem->basis().harmonics() > 1);
    QVERIFY(result->problem->unknownCount() < result->problem->size());
    QCOMPARE(result->summary()["unknowns"].get<Eigen::Index>(), result->problem->unknownCount());
    result->write(directory);
    const auto read = HarmonicResult::read(scene, directory);
    QCOMPARE(read->problem->coordinateHarmonics(), result->problem->coordinateHarmonics());
    QCOMPARE(read->points.front().z, result->points.front().z);
    QCOMPARE(*read->leftOut, *result->leftOut);
    QVERIFY((read->sensitivity->derivative() - result->sensitivity->derivative()).norm() <
            1e-9 * result->sensitivity->derivative().norm());
  }

  void tooManyUnknownsAreRefused() {
    const Scene scene = test::parse(test::fullScene)
                            .withValue("/geometry/0/length_cells", 100)
                            .withValue("/studies/0/samples", 500)
                            .withValue("/studies/0/harmonics", 200);
    try {
      scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "motion");
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      QCOMPARE(QString::fromStdString(error.location()), "test.json: /studies/0/harmonics");
    }
    QVERIFY_EXCEPTION_THROWN(
        scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "nothing"), base::InputError);
  }

  void expectedValuesAreCompared() {
    const Scene scene = oscillator();
    const auto values = scene::compareWithExpected(scene, "motion", run(scene, "motion")->summary());
    QCOMPARE(values.size(), 2u);
    QCOMPARE(values[0].holds(), std::abs(std::abs(closedForm(4)) - 0.2) <= 0.1);
    QVERIFY(!values[1].holds());
    QVERIFY(scene::compareWithExpected(scene, "response", run(scene, "response")->summary())[0].holds());
  }

  void theHashFollowsTheContent() {
    const Scene scene = oscillator();
    QCOMPARE(scene::hashScene(scene), scene::hashScene(oscillator()));
    QVERIFY(scene::hashScene(scene) != scene::hashScene(scene.withValue("/point_masses/0/mass", 3)));
    QCOMPARE(scene::hashScene(scene), scene::hashScene(scene.withValue("/point_masses/0/mass", "2000 g")));
  }
};

QTEST_GUILESS_MAIN(TestStudies)
#include "test_studies.moc"
