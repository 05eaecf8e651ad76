#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "ui/jobs/cloth_session.hpp"

using namespace pliant;
using jobs::ClothSession;

namespace {

constexpr int patience = 60'000;  // milliseconds
constexpr double kept = 1e-6;     // of the limit

/// A sheet of half a metre that hangs from two corners, and may stretch by 1 %.

constexpr char sheet[] = R"json({
  "schema_version": 1,
  "geometry": [{"name": "cloth", "type": "grid", "length": 0.5, "width": 0.5, "length_cells": 4, "width_cells": 4}],
  "materials": [{"name": "fabric", "density": 200, "young_modulus": 1800, "poisson_ratio": 0.41}],
  "elements": [{"name": "sheet", "type": "shell", "thickness": "0.5 mm"}],
  "stretch_limits": [{"name": "all", "type": "isotropic", "stretch": 1.01}],
  "boundary_conditions": [
    {"name": "first", "type": "pin", "at": {"nearest": [0, -0.25, 0]}},
    {"name": "second", "type": "pin", "at": {"nearest": [0, 0.25, 0]}}],
  "loads": [{"name": "weight", "type": "gravity", "acceleration": [0, 0, -9.81]}],
  "studies": [{"name": "swing", "type": "cloth_motion", "duration": 0.1, "time_step": 0.01},
              {"name": "other", "type": "cloth_motion", "duration": 0.1, "time_step": 0.02}]
})json";

double violationOf(const scene::ClothFrame& frame) { return frame.stretchRatios.maxCoeff() - 1; }

}  // namespace

/// A live cloth: it goes on, is pulled, recorded, edited, and ends at any time.
class TestClothSession : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    file_ = folder_.filePath("sheet.json");
    QFile file(file_);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(sheet);
  }

  void init() {
    document_ = std::make_unique<document::Document>();
    QVERIFY(document_->open(file_));
    session_ = std::make_unique<ClothSession>(*document_);
  }
  void cleanup() {
    session_.reset();
    document_.reset();
  }

  void itStepsPlaysPausesAndBeginsAgain() {
    openStudy();
    QVERIFY(!session_->isPlaying());
    QCOMPARE(time(), 0.0);
    for (int i = 1; i <= 3; ++i) {
      session_->step();
      QTRY_VERIFY_WITH_TIMEOUT(std::abs(time() - 0.01 * i) < 1e-12, patience);
    }
    // The same as the study.
    base::ExecutionContext context;
    const auto setup = scene::clothMotionSetup(document_->scene(), document_->model(), "swing");
    cloth::ClothSimulation simulation(setup.problem, setup.stepping);
    for (int i = 0; i < 3; ++i) simulation.step(context);
    QVERIFY(session_->state().frame->positions == simulation.state().positions);

    QSignalSpy playing(session_.get(), &ClothSession::playingChanged);
    session_->setPlaying(true);
    QTRY_VERIFY_WITH_TIMEOUT(time() > 0.2, patience);
    QVERIFY(session_->state().speed > 0 && session_->state().speed < 1.01);
    QVERIFY(session_->state().violation < kept);
    session_->setPlaying(false);
    QCOMPARE(playing.count(), 2);
    QTest::qWait(100);
    const double paused = time();
    QTest::qWait(200);
    QCOMPARE(time(), paused);
    session_->reset();
    QTRY_COMPARE_WITH_TIMEOUT(time(), 0.0, patience);
  }

  void aPulledNodeMovesAndTheLimitIsKept() {
    openStudy();
    session_->setPlaying(true);
    const int node = freeCorner();
    const Eigen::Vector3d hand = session_->state().frame->positions.col(node) + Eigen::Vector3d(-0.1, 0, 0.1);
    double worst = 0;
    connect(session_.get(), &ClothSession::stateChanged, this,
            [&] { worst = std::max(worst, violationOf(*session_->state().frame)); });
    session_->pull(node, hand);
    QTRY_VERIFY_WITH_TIMEOUT(session_->state().frame->positions.col(node) == hand, patience);
    QCOMPARE(session_->state().held.size(), std::size_t(1));
    QCOMPARE(session_->state().held[0].node, node);
    session_->letGo(node, false);
    QTRY_VERIFY_WITH_TIMEOUT(session_->state().held.empty(), patience);
    QTRY_VERIFY_WITH_TIMEOUT((session_->state().frame->positions.col(node) - hand).norm() > 0.01, patience);
    QVERIFY(worst < kept);
    session_->disconnect(this);
  }

  void aHandThatPullsTooFarIsReportedAndTheClothGoesOn() {
    openStudy();
    session_->setPlaying(true);
    const int node = freeCorner();
    session_->pull(node, Eigen::Vector3d(5, 0, 0));
    QTRY_VERIFY_WITH_TIMEOUT(!session_->state().obstacle.isEmpty(), patience);
    QVERIFY(violationOf(*session_->state().frame) < kept);
    const double then = time();
    QTRY_VERIFY_WITH_TIMEOUT(time() > then + 0.05, patience);
    QVERIFY(session_->isPlaying());
    QVERIFY(session_->state().trouble.isEmpty());
    QVERIFY(session_->state().frame->positions.col(node).x() < 0.5 * 1.02 + 0.25);
    session_->letGo(node, false);
    QTRY_VERIFY_WITH_TIMEOUT(session_->state().obstacle.isEmpty(), patience);
  }

  void aRecordingIsTheStudysResult() {
    openStudy();
    session_->setPlaying(true);
    QTRY_VERIFY_WITH_TIMEOUT(time() > 0.05, patience);
    session_->setRecording(true);
    QTRY_VERIFY_WITH_TIMEOUT(session_->state().recordedSeconds > 0.1, patience);
    QVERIFY(!document_->study("swing")->result);
    session_->setRecording(false);
    QTRY_VERIFY_WITH_TIMEOUT(document_->study("swing")->result, patience);
    const auto result = std::dynamic_pointer_cast<const scene::ClothResult>(document_->study("swing")->result);
    QVERIFY(result);
    QVERIFY(document_->study("swing")->status == document::StudyStatus::solved);
    QCOMPARE(result->frames.front()->time, 0.0);
    QCOMPARE(result->frames.size(), result->steps.size() + 1);
    QVERIFY(result->frames.size() > 10);
    for (std::size_t i = 0; i < result->frames.size(); ++i)
      QVERIFY(std::abs(result->frames[i]->time - 0.01 * static_cast<double>(i)) < 1e-9);
    // It is written and read like any other.
    const std::filesystem::path folder = folder_.filePath("recorded").toStdString();
    result->write(folder);
    QVERIFY(scene::ClothResult::read(document_->scene(), folder)->frames.back()->positions ==
            result->frames.back()->positions);
  }

  void closingKeepsWhatWasRecorded() {
    openStudy();
    session_->setRecording(true);
    session_->setPlaying(true);
    QTRY_VERIFY_WITH_TIMEOUT(session_->state().recordedSeconds > 0.02, patience);
    session_->close();
    QVERIFY(!session_->isOpen() && !session_->isRecording() && !session_->isPlaying());
    QTRY_VERIFY_WITH_TIMEOUT(document_->study("swing")->result, patience);
    // Another may begin at once.
    session_->open("other");
    QTRY_VERIFY_WITH_TIMEOUT(session_->state().frame, patience);
    session_->step();
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(time() - 0.02) < 1e-12, patience);
  }

  void editsAreTakenOver() {
    openStudy();
    session_->setPlaying(true);
    QTRY_VERIFY_WITH_TIMEOUT(time() > 0.1, patience);
    const auto before = session_->state().problem;
    QVERIFY(document_->setValue("/stretch_limits/0/stretch", 1.1, "Loosen"));
    QTRY_VERIFY_WITH_TIMEOUT(session_->state().problem != before, patience);
    QVERIFY(time() > 0.1);
    const int node = freeCorner();
    session_->pull(node, Eigen::Vector3d(5, 0, 0));
    // Farther than the limit of before allowed: the corner's pin is half a metre away.
    const auto stretch = [&] {
      const Eigen::Matrix3Xd& now = session_->state().frame->positions;
      return (now.col(node) - now.col(pinnedCorner())).norm() / 0.5;
    };
    QTRY_VERIFY_WITH_TIMEOUT(stretch() > 1.03, patience);
    QVERIFY(stretch() < 1.1 * (1 + kept));
    // Without its study there is nothing to show.
    QVERIFY(document_->setValue("/studies", scene::Json::array(), "Remove studies"));
    QVERIFY(!session_->isOpen());
  }

  void whatCannotBeBuiltIsSaid() {
    QStringList said;
    connect(document_.get(), &document::Document::messageRaised, this,
            [&](base::Severity, const QString& sentence) { said << sentence; });
    session_->open("no such study");
    session_->setPlaying(true);
    QTRY_VERIFY_WITH_TIMEOUT(!said.isEmpty(), patience);
    QVERIFY(said[0].contains("no such study"));
    QTRY_VERIFY_WITH_TIMEOUT(!session_->isPlaying(), patience);
    session_->setRecording(true);
    session_->close();
  }

  void itEndsAtAnyTime() {
    for (int i = 0; i < 5; ++i) {
      session_->open("swing");
      session_->setPlaying(true);
      session_->setRecording(true);
      session_->pull(24, Eigen::Vector3d(3, 0, 0));
      QTest::qWait(20 * i);
      if (i == 2) QVERIFY(document_->open(file_));
      if (i == 3) session_ = std::make_unique<ClothSession>(*document_);
    }
    // Another scene has nothing of the one before.
    session_->close();
    QVERIFY(document_->open(file_));
    QTest::qWait(100);
    QVERIFY(!document_->study("swing")->result);
  }

 private:
  void openStudy() {
    session_->open("swing");
    QTRY_VERIFY_WITH_TIMEOUT(session_->state().frame, patience);
  }
  double time() const { return session_->state().frame->time; }
  int nodeAt(double x, double y) const {
    Eigen::Index node;
    const auto rest = document_->model()->restPositions.reshaped(3, document_->model()->nodeCount());
    (rest.colwise() - Eigen::Vector3d(x, y, 0)).colwise().squaredNorm().minCoeff(&node);
    return static_cast<int>(node);
  }
  int freeCorner() const { return nodeAt(0.5, 0.25); }
  int pinnedCorner() const { return nodeAt(0, 0.25); }

  QTemporaryDir folder_;
  QString file_;
  std::unique_ptr<document::Document> document_;
  std::unique_ptr<ClothSession> session_;
};

QTEST_MAIN(TestClothSession)
#include "test_cloth_session.moc"
