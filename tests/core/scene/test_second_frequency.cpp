#include <QFloat16>  // comparing JSON asks about every type that Qt can compare
#include <QTemporaryDir>
#include <QTest>
#include <complex>

#include "core/base/error.hpp"
#include "core/harmonic/motion_chart.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/second_frequency.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using scene::HarmonicResult;
using scene::Json;
using scene::Scene;
namespace fs = std::filesystem;

namespace {

/// m x'' + c x' + k x = F cos ωt + G cos(r ωt + 1) on a line, with `motion` and `response` as more keys of these
/// studies.
Scene twoForces(const std::string& motion, const std::string& response = R"("frequency_ratio": 1.4142135623730951)",
                const std::string& of = "second_frequency", const std::string& more = "") {
  return test::parse(R"({"schema_version": 1, "dimension": 1,
    "geometry": [{"name": "p", "type": "points", "points": [[0.5]]}],
    "point_masses": [{"name": "bob", "at": {"nodes": [0]}, "mass": 2}],
    "springs": [{"name": "k", "type": "grounded", "at": {"nodes": [0]}, "direction": [1], "coefficients": [50]}],
    "damping": {"mass_proportional": 0.3},
    "loads": [{"name": "F", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1],
               "harmonics": [{"amplitude": 4}, {"of": ")" +
                     of + R"(", "order": 1, "amplitude": 3, "phase": 1}]}],
    "probes": [{"name": "bob", "at": {"nodes": [0]}}],
    "studies": [{"name": "motion", "type": "periodic_motion", "frequency": 4, "harmonics": 3, "samples": 13)" +
                     (motion.empty() ? "" : ", " + motion) + R"(},
                {"name": "response", "type": "frequency_response", "from": 3, "to": 6, "harmonics": 1, "samples": 5)" +
                     (response.empty() ? "" : ", " + response) + "}" + more + "]}");
}

const std::string root = R"("second_frequency": 5.656854249492381)";

std::shared_ptr<const HarmonicResult> run(const Scene& scene, const char* study) {
  base::ExecutionContext context;
  const auto result = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study)->run(context);
  return std::dynamic_pointer_cast<const HarmonicResult>(result);
}

/// What is said where a study is made, or a scene is read.
template <class Make>
std::string refusal(const Make& make) {
  try {
    make();
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

std::string refusalOfStudy(const Scene& scene, const char* study) {
  return refusal([&] { scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study); });
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

class TestSecondFrequency : public QObject {
  Q_OBJECT

 private slots:
  void theSummarySaysBothFrequencies() {
    const auto result = run(twoForces(root), "motion");
    QVERIFY(result->warnings().empty());
    const Json summary = result->summary();
    QCOMPARE(summary["termination"], Json("converged"));
    QVERIFY(std::abs(summary["second_frequency"].get<double>() - 4 * std::sqrt(2)) < 1e-12);
    QCOMPARE(summary["harmonics"], Json(3));
    QCOMPARE(summary["samples"], Json(13));
    QCOMPARE(summary["combinations"], Json(12));
    QCOMPARE(summary["span_periods"], Json(29));
    QCOMPARE(summary["stability"], Json("unknown"));
    QVERIFY(summary["residual"].get<double>() < 1e-8);
    // The linear oscillator answers each force alone: 50 - 2 ω² + 0.6 i ω.
    const Json& probe = summary["probes"][0];
    const double first = 4 / std::abs(std::complex(50 - 2 * 16.0, 0.6 * 4));
    const double second = 3 / std::abs(std::complex(50 - 2 * 32.0, 0.6 * 4 * std::sqrt(2)));
    QVERIFY(std::abs(probe["maximum_displacement"].get<double>() - (first + second)) < 1e-9);
    const Json& combinations = probe["combinations"];
    for (const auto& [at, k1, amplitude] : {std::tuple(0, 1, first), {1, 0, second}}) {
      QCOMPARE(combinations[at]["k1"], Json(k1));
      QCOMPARE(combinations[at]["k2"], Json(1 - k1));
      QVERIFY(std::abs(combinations[at]["amplitude"].get<double>() - amplitude) < 1e-10);
    }
    QVERIFY(combinations[2]["amplitude"].get<double>() < 1e-12);
  }

  void whatIsWrittenIsReadBack_data() {
    QTest::addColumn<QString>("study");
    QTest::addColumn<int>("rows");
    QTest::newRow("motion") << "motion" << 29 * 64;
    QTest::newRow("response") << "response" << 64;
  }
  void whatIsWrittenIsReadBack() {
    QFETCH(QString, study);
    QFETCH(int, rows);
    const Scene scene = twoForces(root);
    const auto result = run(scene, study.toLatin1());
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    const QTemporaryDir folder;
    result->write(folder.path().toStdString());
    const auto read = HarmonicResult::read(scene, folder.path().toStdString());
    QCOMPARE(read->points.size(), result->points.size());
    QCOMPARE(read->problem->basis().ratio(), result->problem->basis().ratio());
    for (std::size_t i = 0; i < read->points.size(); ++i) {
      QVERIFY(read->points[i].z == result->points[i].z);
      QVERIFY(read->points[i].omega == result->points[i].omega);
      QVERIFY(read->problemOf(read->points[i])->configurationAt(read->points[i].z, 1.3) ==
              result->problemOf(result->points[i])->configurationAt(result->points[i].z, 1.3));
    }
    const auto pathOf = [&](const char* file) { return fs::path(folder.path().toStdString()) / file; };
    const std::string trajectories = scene::readTextFile(pathOf("trajectories.csv"));
    const auto table = scene::readCsv(trajectories);
    QCOMPARE(table.size(), result->points.size() * static_cast<std::size_t>(rows));
    // The second row is at ωt = 2π / 64, of the first frequency.
    const double tau = scene::csvNumber(table[1][2]) / 29;
    QVERIFY(std::abs(tau * 29 - 2 * 3.14159265358979 / 64) < 1e-12);
    QCOMPARE(scene::csvNumber(table[1][3]), read->problem->configurationAt(read->points[0].z, tau)[0]);
    const std::string combinations = scene::readTextFile(pathOf("combinations.csv"));
    QCOMPARE(scene::readCsv(combinations).size(),
             result->points.size() * static_cast<std::size_t>(result->problem->basis().harmonics()));
  }

  void chartsRunOverTheSpan() {
    const auto result = run(twoForces(root), "motion");
    const double span = 29 * 2 * std::acos(-1) / 4;
    for (const harmonic::MotionChartKind& kind : harmonic::motionChartKinds()) {
      const auto chart = kind.make(*result->problem, result->points[0].z, 4, 0);
      if (kind.key == "displacement" || kind.key == "velocity") {
        const auto& times = chart.series.at(0).x;
        QVERIFY(std::abs(times[times.size() - 1] - span) < 1e-9);
      }
      if (kind.key == "harmonics") {
        const auto& series = chart.series.at(0);
        Eigen::Index second = 0;
        for (Eigen::Index i = 0; i < series.x.size(); ++i)
          if (std::abs(series.x[i] - std::sqrt(2)) < 1e-9) second = i;
        QVERIFY(series.y[second] > 0.1);
      }
    }
  }

  void whatDoesNotApplyIsRefused() {
    const Scene bare =
        twoForces("", "", "second_frequency", R"(, {"name": "newmark", "type": "time_integration", "frequency": 4})");
    QVERIFY(has(refusalOfStudy(bare, "motion"), "needs \"second_frequency\""));
    QVERIFY(has(refusalOfStudy(bare, "motion"), "/studies/0"));
    QVERIFY(has(refusalOfStudy(bare, "response"), "needs \"frequency_ratio\""));
    QVERIFY(has(refusalOfStudy(bare, "newmark"), "\"time_integration\" do not know"));
    QVERIFY(
        has(refusalOfStudy(twoForces(root + R"(, "harmonics_tolerance": 0.01)"), "motion"), "/harmonics_tolerance"));
    const std::string ratio = R"("frequency_ratio": 1.4)";
    QVERIFY(has(refusalOfStudy(twoForces(root, ratio + R"(, "branches": 1)"), "response"), "/branches"));
    QVERIFY(
        has(refusalOfStudy(twoForces(root, ratio + R"(, "peak_sensitivity": true)"), "response"), "/peak_sensitivity"));
    for (const char* value : {"0", "-5", "\"2 m\""})
      QVERIFY(has(
          refusal([&] { twoForces("\"second_frequency\": " + std::string(value)); }), "/studies/0/second_frequency"));
    QVERIFY(has(refusal([&] { twoForces(root, "\"frequency_ratio\": -1"); }), "/studies/1/frequency_ratio"));
    QVERIFY(has(refusal([&] { twoForces(root, ratio, "third"); }), "/loads/0/harmonics/1/of"));
  }

  void whatIsNeedlessIsWarnedOf() {
    const auto whole = run(twoForces(R"("second_frequency": 6)"), "motion")->warnings();
    QCOMPARE(whole.size(), std::size_t(1));
    QVERIFY(has(whole[0], "as 2 to 3"));
    const auto unused = run(twoForces(root, "", "frequency"), "motion")->warnings();
    QCOMPARE(unused.size(), std::size_t(1));
    QVERIFY(has(unused[0], "No drive or load"));
  }
};

QTEST_GUILESS_MAIN(TestSecondFrequency)
#include "test_second_frequency.moc"
