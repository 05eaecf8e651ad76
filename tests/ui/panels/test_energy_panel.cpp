#include <QComboBox>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "tests/ui/panels/sheet_scene.hpp"
#include "ui/jobs/study_runner.hpp"
#include "ui/panels/energy_panel.hpp"

using namespace pliant;

namespace {

constexpr int patience = 60'000;  // milliseconds

/// A run of which every number is known.
std::shared_ptr<scene::ClothResult> makeRun(double scale) {
  auto result = std::make_shared<scene::ClothResult>();
  for (int i = 1; i <= 5; ++i) {
    scene::ClothStepRecord step;
    step.time = 0.1 * i;
    step.energies.kinetic = scale * i;
    step.energies.gravity = -scale;
    step.violation = 1e-9 * i;
    step.relativeGap = 1e-10;
    step.newtonIterations = 2 * i;
    step.projectionIterations = 10 + i;
    result->steps.push_back(step);
  }
  for (int i = 0; i < 4; ++i)
    result->lastProjection.iterations.push_back({i, std::pow(10, -i), 1, std::pow(10, -2 * i)});
  return result;
}

}  // namespace

/// Charts of cloth studies.
class TestEnergyPanel : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    QFile file(folder_.filePath("sheet.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(sheetScene);
  }

  void chartsSayWhatTheRecordsSay() {
    const std::vector<panels::ClothRun> runs{{"a", makeRun(1), 0}, {"b", makeRun(2), 1}};
    const auto& kinds = panels::clothChartKinds();
    for (const panels::ClothChartKind& kind : kinds) {
      const plots::LineChart chart = kind.make(runs);
      if (kind.ofMany) QCOMPARE(chart.lines.size(), runs.size());
      for (const plots::PlotLine& line : chart.lines) QCOMPARE(line.x.size(), line.y.size());
      QVERIFY(kind.make({}).lines.empty());
    }
    const plots::LineChart total = kinds[0].make(runs);
    QCOMPARE(total.lines[1].name, QString("b"));
    QCOMPARE(total.lines[1].x[2], 0.1 * 3);
    QCOMPARE(total.lines[1].y[2], 4.0);
    // Parts that are nowhere are left out.
    const plots::LineChart parts = kinds[1].make(runs);
    QCOMPARE(parts.lines.size(), std::size_t(3));
    QCOMPARE(parts.lines[2].name, QString("gravity"));
    QVERIFY(kinds[2].make(runs).logarithmicY);
    const plots::LineChart last = kinds[5].make(runs);
    QCOMPARE(last.lines[0].y[3], 1e-3);
    QCOMPARE(last.lines[1].y[3], 1e-6);
  }

  void studiesFillTheCharts() {
    document::Document document;
    jobs::JobRunner jobs;
    jobs::StudyRunner studies(document, jobs);
    panels::EnergyPanel panel(document);
    panel.resize(640, 300);
    panel.show();
    QVERIFY(document.open(folder_.filePath("sheet.json")));
    QCOMPARE(panel.studies()->count(), 2);  // the modes are not of cloth
    QVERIFY(panel.plot()->toCsv().isEmpty());
    studies.run({"swing", "project"});
    const auto done = [&](const char* name) { return document.study(name)->status == document::StudyStatus::solved; };
    QTRY_VERIFY_WITH_TIMEOUT(done("swing") && done("project"), patience);
    QCOMPARE(panel.plot()->chart().lines.size(), std::size_t(2));
    QCOMPARE(panel.plot()->toCsv().trimmed().split('\n').size(), 1 + 10);
    // Each study keeps its colour when another one is chosen.
    QCOMPARE(panel.plot()->chart().lines[0].name, QString("swing"));
    const int color = panel.plot()->chart().lines[1].group;
    panel.setStudy("project");
    QCOMPARE(panel.plot()->chart().lines[0].name, QString("project"));
    QCOMPARE(panel.plot()->chart().lines[0].group, color);
    // A change of a limit makes both stale, and undoing it fresh again.
    QVERIFY(document.setValue("/stretch_limits/0/stretch", 1.02, "edit"));
    QVERIFY(document.study("swing")->stale && document.study("project")->stale);
    document.undoStack().undo();
    QVERIFY(!document.study("swing")->stale);
  }

 private:
  QTemporaryDir folder_;
};

QTEST_MAIN(TestEnergyPanel)
#include "test_energy_panel.moc"
