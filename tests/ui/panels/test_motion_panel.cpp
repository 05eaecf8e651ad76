#include <QComboBox>
#include <QSignalSpy>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <numbers>

#include "core/base/error.hpp"
#include "ui/jobs/motion_session.hpp"
#include "ui/panels/modes_panel.hpp"
#include "ui/panels/motion_panel.hpp"
#include "ui/panels/response_overlays.hpp"
#include "ui/panels/response_panel.hpp"
#include "ui/plots/chart_plot.hpp"

using namespace pliant;

namespace {
constexpr int patience = 60'000;  // milliseconds
}

/// Charts of the motion on show, and measurements over a response curve.
class TestMotionPanel : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    document_ = std::make_unique<document::Document>();
    QVERIFY(document_->open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json")));
    studies_ = std::make_unique<jobs::StudyRunner>(*document_, studyJobs_);
    session_ = std::make_unique<jobs::MotionSession>(*document_, quick_, *studies_);
  }

  void cleanup() {
    session_.reset();
    studies_.reset();
    document_.reset();
  }

  void everyKindOfChartFollowsTheMotion() {
    panels::MotionPanel panel(*session_);
    panel.resize(640, 300);
    panel.show();
    QVERIFY(panel.plot()->toCsv().isEmpty());
    session_->run({"motion"});
    QTRY_VERIFY_WITH_TIMEOUT(session_->shown() && !session_->effects().empty(), patience);
    for (int kind = 0; kind < panel.kinds()->count(); ++kind) {
      panel.kinds()->setCurrentIndex(kind);
      const auto& maker = harmonic::motionChartKinds().at(kind);
      const auto chart = maker.make(
          *session_->shown()->problem, session_->shown()->motion.z, session_->shown()->motion.omega, session_->node());
      // As many lines as the chart has places, under a header; none where there is only a note.
      const auto lines = panel.plot()->toCsv().split('\n', Qt::SkipEmptyParts).size();
      QCOMPARE(lines, chart.series.empty() ? 0 : chart.series[0].x.size() + 1);
    }
    panel.kinds()->setCurrentIndex(1);
    QVERIFY(panel.plot()->toCsv().startsWith("Time [s],Displacement from the mean [m]"));
  }

  void aModeIsPlayedUntilItIsLeft() {
    QVERIFY(document_->open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/spring_chain.json")));
    panels::ModesPanel panel(*document_, *session_);
    QCOMPARE(panel.table()->rowCount(), 0);
    session_->run({"modes"});
    QTRY_VERIFY_WITH_TIMEOUT(panel.table()->rowCount() > 0, patience);
    QSignalSpy chosen(&panel, &panels::ModesPanel::modeChosen), left(&panel, &panels::ModesPanel::modeLeft);
    Q_EMIT panel.table()->cellClicked(1, 0);
    QCOMPARE(panel.playedMode(), 1);
    QCOMPARE(chosen.count(), 1);
    const auto problem = chosen[0][0].value<std::shared_ptr<const harmonic::HarmonicBalanceProblem>>();
    const auto z = chosen[0][1].value<harmonic::Vector>();
    // The second mode of the chain has one node: neighbours at both ends swing against one another.
    const auto at = [&](double tau, int node) {
      return problem->configurationAt(z, tau)[node] - problem->model().restPositions[node];
    };
    const double quarter = std::numbers::pi / 2;
    QVERIFY(at(quarter, 1) * at(quarter, 4) < 0);
    QVERIFY(std::abs(at(quarter, 1) + at(-quarter, 1)) < 1e-12);
    Q_EMIT panel.table()->cellClicked(1, 0);
    QCOMPARE(panel.playedMode(), -1);
    QCOMPARE(left.count(), 1);
  }

  void measurementsAreReadWithTheirUnits() {
    QTemporaryDir folder;
    const auto write = [&](const char* text) {
      const QString name = folder.filePath("measured.csv");
      QFile file(name);
      file.open(QIODevice::WriteOnly);
      file.write(text);
      return name;
    };
    const plots::ResponseOverlay read =
        panels::readMeasurements(write("frequency [Hz],amplitude [mm],who\n1,20,me\n2,30,you\n"));
    QCOMPARE(read.name, QString("measured"));
    QVERIFY(std::abs(read.omega.at(1) - 4 * std::numbers::pi) < 1e-12);
    QVERIFY(std::abs(read.amplitude.at(1) - 0.03) < 1e-15);
    for (const char* bad :
         {"", "frequency,amplitude\n1,2\n", "frequency [Hz],amplitude [s]\n1,2\n", "frequency [Hz],amplitude [mm]\n1\n",
          "frequency [Hz],amplitude [mm]\n1,nan\n", "frequency [Hz],amplitude [mm]\n"})
      QVERIFY_EXCEPTION_THROWN(panels::readMeasurements(write(bad)), base::InputError);

    panels::ResponsePanel panel(*document_, *session_, quick_);
    panel.addMeasurements(write("frequency [rad/s],amplitude [m]\n1,0.1\n"));
    QCOMPARE(panel.plot()->overlays().size(), std::size_t(1));
    QVERIFY(panel.plot()->overlays()[0].dots);
  }

 private:
  jobs::JobRunner studyJobs_, quick_;
  std::unique_ptr<document::Document> document_;
  std::unique_ptr<jobs::StudyRunner> studies_;
  std::unique_ptr<jobs::MotionSession> session_;
};

QTEST_MAIN(TestMotionPanel)
#include "test_motion_panel.moc"
