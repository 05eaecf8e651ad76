#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>

#include "core/scene/design_space_result.hpp"
#include "ui/jobs/job_runner.hpp"
#include "ui/panels/chart_panel.hpp"
#include "ui/plots/line_plot.hpp"

using namespace pliant;

/// What can be reached, and measured motions, in charts.
class TestChartPanel : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// A result comes; its designs and paths are drawn, and exported as a table; another scene clears them.
  void showsADesignSpace() {
    document::Document document;
    jobs::JobRunner quick;
    QVERIFY(document.open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/strip_budget.json")));
    panels::ChartPanel panel(document, quick);
    QVERIFY(panel.hasStudies());
    QCOMPARE(panel.study(), "space");
    QVERIFY(panel.plots().empty());
    scene::Json small = document.scene().json();
    for (scene::Json& study : small["studies"])
      if (study["name"] == "space") study["count"] = 6;
    QVERIFY(document.setValue("/studies", small["studies"], QStringLiteral("fewer designs")));
    base::ExecutionContext context;
    const scene::Scene& scene = document.scene();
    const auto result = scene::StudyRegistry::instance().make(scene, document.model(), "space")->run(context, {});
    document.setResult("space", result, scene);
    QTRY_VERIFY(panel.plots().size() >= 2);
    const plots::LineChart& designs = panel.plots()[0]->chart();
    const auto shown = std::find_if(designs.lines.begin(), designs.lines.end(),
                                    [](const auto& line) { return line.dots && !line.joined && line.x.size() == 6; });
    QVERIFY(shown != designs.lines.end());
    QTemporaryDir folder;
    panel.exportTo(folder.filePath("designs.csv"));
    QFile table(folder.filePath("designs.csv"));
    QVERIFY(table.open(QIODevice::ReadOnly));
    QVERIFY(table.readAll().count('\n') >= 7);
    QVERIFY(document.open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json")));
    QVERIFY(!panel.hasStudies() && panel.plots().empty());
  }
};

QTEST_MAIN(TestChartPanel)
#include "test_chart_panel.moc"
