#include <QTemporaryDir>
#include <QTest>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/result_charts.hpp"
#include "core/scene/study.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using Mark = scene::ResultSeries::Mark;

namespace {

/// A hardening oscillator whose curve folds twice, unstable in between.
const std::string oscillator = R"({
  "schema_version": 1,
  "title": "Oscillator",
  "dimension": 1,
  "geometry": [{"name": "place", "type": "points", "points": [[0]]}],
  "point_masses": [{"name": "bob", "at": {"nodes": [0]}, "mass": 1}],
  "springs": [{"name": "spring", "type": "grounded", "at": {"nodes": [0]}, "direction": [1], "coefficients": [1, 0, 0.5]}],
  "damping": {"mass_proportional": 0.04},
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1],
             "harmonics": [{"amplitude": 0.1}]}],
  "probes": [{"name": "bob", "at": {"nodes": [0]}}],
  "studies": [
    {"name": "curve", "type": "frequency_response", "from": 0.5, "to": 2, "harmonics": 3},
    {"name": "linear", "type": "linear_response", "from": 0.5, "to": 2, "harmonics": 3},
    {"name": "motion", "type": "periodic_motion", "frequency": 0.8, "harmonics": 3},
    {"name": "time", "type": "time_integration", "frequency": 0.8, "steps_per_period": 64, "extrapolate": true},
    {"name": "modes", "type": "linear_modes", "count": 1},
    {"name": "comparison", "type": "comparison", "frequency": 0.8, "harmonic_counts": [1, 3, 5], "steps_per_period": [64, 128]}
  ]
})";

}  // namespace

class TestResultCharts : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    const auto model = scene::buildModel(scene_);
    base::ExecutionContext context;
    for (const std::string& study : scene::studyNames(scene_))
      scene::StudyRegistry::instance().make(scene_, model, study)->run(context)->write(folder() / study);
  }

  /// The unstable part between the folds is dashed, in the colour of the rest; folds and the peak are points.
  void curvesShowStability() {
    const auto charts = scene::resultCharts(scene_, folder(), {"curve"}, "displacement");
    QCOMPARE(charts.size(), 1u);
    QCOMPARE(charts[0].title, std::string("Oscillator"));
    std::vector<Mark> marks;
    for (const auto& series : charts[0].series) {
      marks.push_back(series.mark);
      QCOMPARE(series.x.size(), series.y.size());
      QCOMPARE(series.group, 0);
    }
    QCOMPARE(marks, (std::vector{Mark::line, Mark::dashedLine, Mark::line, Mark::points}));
    QCOMPARE(charts[0].series[0].name, std::string("curve, bob"));
    QCOMPARE(charts[0].series[1].name, std::string());
    QCOMPARE(charts[0].series[1].x.front(), charts[0].series[0].x.back());
    QCOMPARE(charts[0].series[1].x.back(), charts[0].series[2].x.front());
    const auto& special = charts[0].series[3];
    QCOMPARE(special.x.size(), 3u);
    // The backbone's amplitude at the peak: ω² = 1 + 3/4 γ A² - 2 ζ², in millimetres.
    const double highest = *std::max_element(special.y.begin(), special.y.end());
    QVERIFY(highest > 1000 && highest < 3000);
  }

  void studiesLieOverOneAnother() {
    const auto charts = scene::resultCharts(scene_, folder(), {"curve", "linear", "motion", "time"}, "path-length");
    QCOMPARE(charts.size(), 1u);
    std::map<int, std::string> names;
    for (const auto& series : charts[0].series)
      if (!series.name.empty()) names[series.group] = series.name;
    QCOMPARE(names,
             (std::map<int, std::string>{{0, "curve, bob"}, {1, "linear, bob"}, {2, "motion, bob"}, {3, "time, bob"}}));
    const auto& motion = charts[0].series[charts[0].series.size() - 2];
    const auto& time = charts[0].series.back();
    QVERIFY(motion.mark == Mark::points && time.mark == Mark::points);
    QCOMPARE(motion.x, time.x);
    QVERIFY(std::abs(motion.y[0] - time.y[0]) < 0.01 * time.y[0]);
  }

  void comparisonsShowErrors() {
    const auto charts = scene::resultCharts(scene_, folder(), {"comparison"}, "path-length");
    QCOMPARE(charts.size(), 2u);
    QVERIFY(!charts[0].logarithmicX && charts[0].logarithmicY && charts[1].logarithmicX && charts[1].logarithmicY);
    QCOMPARE(charts[0].series.front().x, (std::vector<double>{1, 3, 5}));
    QCOMPARE(charts[1].series.front().x, (std::vector<double>{64, 128}));
    for (const auto& chart : charts) QVERIFY(chart.series.front().y.back() < chart.series.front().y.front());
  }

  /// Without a choice, whatever has a chart is drawn, and modes are passed over.
  void allThereIs() { QCOMPARE(scene::resultCharts(scene_, folder(), {}, "path-length").size(), 3u); }

  void mistakesAreNamed() {
    const auto message = [&](const std::vector<std::string>& studies, const std::string& quantity) {
      try {
        scene::resultCharts(scene_, folder(), studies, quantity);
      } catch (const base::InputError& error) {
        return std::string(error.what());
      }
      return std::string();
    };
    QVERIFY(message({"modes"}, "path-length").find("has no chart") != std::string::npos);
    QVERIFY(message({"nothing"}, "path-length").find("no result of the study") != std::string::npos);
    QVERIFY(message({}, "colour").find("no quantity") != std::string::npos);
    const auto summary = folder() / "comparison" / "summary.json";
    const std::string whole = scene::readTextFile(summary);
    scene::writeTextFile(summary, R"({"kind": "comparison"})");
    QVERIFY(message({"comparison"}, "path-length").find("run its study again") != std::string::npos);
    scene::writeTextFile(summary, whole);
    QVERIFY(message({"curve"}, "strain").find("no result that a chart can show") != std::string::npos);
  }

 private:
  std::filesystem::path folder() const { return directory_.path().toStdString(); }

  QTemporaryDir directory_;
  const scene::Scene scene_ = test::parse(oscillator);
};

QTEST_GUILESS_MAIN(TestResultCharts)
#include "test_result_charts.moc"
