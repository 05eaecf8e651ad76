#include <QMouseEvent>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <random>

#include "core/scene/calibration_result.hpp"
#include "core/scene/design_space_result.hpp"
#include "core/scene/json_text.hpp"
#include "ui/panels/chart_panel.hpp"
#include "ui/panels/design_panel.hpp"
#include "ui/panels/study_choice.hpp"
#include "ui/panels/value_card.hpp"
#include "ui/plots/custom_plot.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using document::StudyStatus;
using scene::Json;
using shell::MainWindow;

namespace {

constexpr int patience = 60'000;  // milliseconds
const std::string mass = "/point_masses/0/mass", stiffness = "/springs/0/coefficients/0";

/// m x'' + α m x' + k x = F cos ωt along x, in the plane.
const char* const text = R"({
  "schema_version": 1, "title": "oscillator", "dimension": 2,
  "geometry": [{"name": "body", "type": "points", "points": [[0, 0]]}],
  "point_masses": [{"name": "bob", "at": {"nodes": [0]}, "mass": 2, "minimum": 1.2, "maximum": 3}],
  "springs": [{"name": "spring", "type": "grounded", "at": {"nodes": [0]}, "direction": [1, 0], "coefficients": [1]},
              {"name": "guide", "type": "grounded", "at": {"nodes": [0]}, "direction": [0, 1], "coefficients": [1]}],
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1, 0],
             "harmonics": [{"amplitude": 0.1}]}],
  "damping": {"mass_proportional": 0.1},
  "parameters": [{"name": "stiffness", "pointer": "/springs/0/coefficients/0", "minimum": 0.5, "maximum": 1.2}],
  "probes": [{"name": "bob", "at": {"nodes": [0]}}],
  "studies": [
    {"name": "wide", "type": "design", "frequency": 1.2, "harmonics": 1, "samples": 8,
     "objectives": [{"type": "amplitude", "probes": ["bob"]}]},
    {"name": "narrow", "type": "design", "frequency": 1.2, "harmonics": 1, "samples": 8,
     "objectives": [{"type": "amplitude", "probes": ["bob"], "target": 0.15}]},
    {"name": "space", "type": "design_space", "frequency": 1.2, "harmonics": 1, "samples": 8, "count": 20,
     "measures": [{"type": "total_mass"}, {"type": "path_length", "probe": "bob"}]},
    {"name": "fit", "type": "calibration", "harmonics": 1, "samples": 8, "parameters": ["bob"],
     "measurements": [{"file": "seen.csv", "frequency": 0.8, "time_offset": 0}]}]
})";

/// The closed form with the mass 2.3.
std::string measurement() {
  const double omega = 0.8, a = 1 - 2.3 * omega * omega, b = 0.1 * 2.3 * omega;
  std::string table = "time [s],bob x [m]\n";
  std::mt19937 random(3);
  std::normal_distribution<double> error(0, 1e-4);
  for (int i = 0; i < 40; ++i)
    table += std::to_string(0.2 * i) + "," +
             std::to_string(0.1 * (a * std::cos(omega * 0.2 * i) + b * std::sin(omega * 0.2 * i)) / (a * a + b * b) +
                            error(random)) +
             "\n";
  return table;
}

}  // namespace

/// Designs of a space, fitted values and several designs, chosen and taken in the window.
class TestChartWindow : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    scene::writeTextFile(folder_.filePath("scene.json").toStdString(), text);
    scene::writeTextFile(folder_.filePath("seen.csv").toStdString(), measurement());
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
    QVERIFY(window_->document().open(folder_.filePath("scene.json")));
  }
  void cleanup() { window_.reset(); }

  void aDesignOfASpaceIsLookedAtAndTaken();
  void fittedValuesAreTaken();
  void eachDesignStudyHasItsTurn();

 private:
  void run(const char* study) {
    window_->session().run({study});
    QTRY_VERIFY_WITH_TIMEOUT(window_->document().study(study)->status == StudyStatus::solved, patience);
  }
  double value(const std::string& pointer) const { return window_->document().valueAt(pointer).get<double>(); }
  static QPoint placeOf(const plots::LinePlot& plot, const plots::PlotLine& line, std::size_t i) {
    return {static_cast<int>(std::lround(plot.plot()->xAxis->coordToPixel(line.x[i]))),
            static_cast<int>(std::lround(plot.plot()->yAxis->coordToPixel(line.y[i])))};
  }

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

/// Hovered, its numbers are said; clicked, its motion plays and it is marked in every chart; clicked again, it is left.
void TestChartWindow::aDesignOfASpaceIsLookedAtAndTaken() {
  panels::ChartPanel& panel = window_->charts();
  panel.parentWidget()->raise();
  panel.setStudy("space");
  run("space");
  QTRY_COMPARE_WITH_TIMEOUT(panel.plots().size(), std::size_t(2), patience);
  const auto result =
      std::dynamic_pointer_cast<const scene::DesignSpaceResult>(window_->document().study("space")->result);
  plots::LinePlot& plot = *panel.plots()[0];
  QTRY_VERIFY(plot.chart().lines.size() > 1 && plot.chart().lines[0].x.size() == 20);
  QCoreApplication::processEvents();
  QVERIFY(!panel.card()->isVisibleTo(&panel));

  const plots::PlotLine& line = plot.chart().lines[0];
  const int design = line.items.at(4);
  const harmonic::SampledDesign& chosen = result->space.designs[static_cast<std::size_t>(design)];
  QCOMPARE(line.x[4], 1e3 * result->measures[0].of(chosen));
  const QPoint place = placeOf(plot, line, 4);
  QSignalSpy spy(&panel, &panels::ChartPanel::designChosen);
  QMouseEvent hover(
      QEvent::MouseMove, place, plot.plot()->mapToGlobal(place), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QCoreApplication::sendEvent(plot.plot(), &hover);
  QVERIFY(plot.hoverText().contains(QStringLiteral("design %1").arg(design)));
  QVERIFY(plot.hoverText().contains(QStringLiteral("stiffness")));
  QTest::mouseClick(plot.plot(), Qt::LeftButton, {}, place);
  QCOMPARE(spy.count(), 1);
  QCOMPARE(panel.chosenDesign(), design);
  const auto motion = spy.at(0).at(0).value<panels::DesignMotion>();
  QVERIFY(motion.z == chosen.z && motion.problem->sharedModel() == chosen.model);
  QVERIFY(QString::fromStdString(window_->viewport().motionView().caption()).contains(motion.label));
  QVERIFY(window_->viewport().isPlaying());
  for (const plots::LinePlot* each : panel.plots()) QCOMPARE(each->chosenItem(), design);
  QVERIFY(panel.card()->isVisibleTo(&panel));
  QCOMPARE(panel.card()->table()->rowCount(), 2);
  QTest::qWait(100);
  if (qEnvironmentVariableIsSet("PLIANT_PICTURES"))
    window_->grab().save(qEnvironmentVariable("PLIANT_PICTURES") + QStringLiteral("/charts.png"));

  panel.chooseDesign(design);
  QCOMPARE(panel.chosenDesign(), -1);
  QVERIFY(!panel.card()->isVisibleTo(&panel));
  panel.chooseDesign(design);
  const int step = window_->document().undoStack().index();
  panel.card()->takeButton()->click();
  QTRY_COMPARE_WITH_TIMEOUT(window_->document().undoStack().index(), step + 1, patience);
  QCOMPARE(value(mass), chosen.values[0]);
  QCOMPARE(value(stiffness), chosen.values[1]);
  window_->document().undoStack().undo();
  QCOMPARE(value(mass), 2.0);
  QCOMPARE(value(stiffness), 1.0);
}

void TestChartWindow::fittedValuesAreTaken() {
  panels::ChartPanel& panel = window_->charts();
  panel.setStudy("fit");
  run("fit");
  QTRY_VERIFY_WITH_TIMEOUT(!panel.plots().empty() && panel.card()->isVisibleTo(&panel), patience);
  QCOMPARE(panel.card()->table()->rowCount(), 1);
  QVERIFY(panel.card()->table()->item(0, 3)->text().startsWith(QStringLiteral("±")));
  const int step = window_->document().undoStack().index();
  panel.card()->takeButton()->click();
  QTRY_COMPARE_WITH_TIMEOUT(window_->document().undoStack().index(), step + 1, patience);
  const auto result =
      std::dynamic_pointer_cast<const scene::CalibrationStudyResult>(window_->document().study("fit")->result);
  QCOMPARE(value(mass), result->calibration.history.back().values[0]);
  QVERIFY(std::abs(value(mass) - 2.3) < 0.01);
  window_->document().undoStack().undo();
  QCOMPARE(value(mass), 2.0);
}

/// What runs takes the dock; either can be chosen afterwards, with its own designs.
void TestChartWindow::eachDesignStudyHasItsTurn() {
  panels::DesignPanel& panel = window_->design();
  QCOMPARE(panel.choice()->count(), 2);
  QCOMPARE(panel.choice()->name(), "wide");
  run("wide");
  const int designs = panel.slider()->maximum();
  const QString wide = panel.summary();
  run("narrow");
  QTRY_COMPARE(panel.choice()->name(), "narrow");
  QTRY_VERIFY(panel.summary() != wide);
  QSignalSpy spy(&panel, &panels::DesignPanel::runRequested);
  panel.choice()->choose("wide");
  QCOMPARE(panel.summary(), wide);
  QCOMPARE(panel.slider()->maximum(), designs);
  panel.take()->click();
  QTRY_VERIFY_WITH_TIMEOUT(window_->document().undoStack().canUndo(), patience);
  const auto result = std::dynamic_pointer_cast<const scene::DesignResult>(window_->document().study("wide")->result);
  QCOMPARE(value(mass), result->after().values[0]);
  // A study that is gone leaves the other one.
  Json studies = window_->document().scene().json().at("studies");
  studies.erase(0);
  QVERIFY(window_->document().setValue("/studies", studies, "remove"));
  QTRY_COMPARE(panel.choice()->name(), "narrow");
}

QTEST_MAIN(TestChartWindow)
#include "test_chart_window.moc"
