#include <QTemporaryDir>
#include <QTest>

#include "ui/jobs/motion_session.hpp"

using namespace pliant;

namespace {

constexpr int patience = 60'000;  // milliseconds

/// x'' + 0.2 x' + x = 0.1 cos ωt, with the frequencies of both studies as parameters.
const char* const text = R"({
  "schema_version": 1, "dimension": 1,
  "geometry": [{"name": "body", "type": "points", "points": [[0]]}],
  "point_masses": [{"name": "mass", "at": {"nodes": [0]}, "mass": 1, "minimum": 0.2, "maximum": 3}],
  "springs": [{"name": "spring", "type": "grounded", "at": {"nodes": [0]}, "direction": [1], "coefficients": [1]}],
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1],
             "harmonics": [{"amplitude": 0.1}]}],
  "damping": {"mass_proportional": 0.2},
  "parameters": [{"name": "slow", "pointer": "/studies/0/frequency", "minimum": 0.2, "maximum": 2},
                 {"name": "fast", "pointer": "/studies/1/frequency", "minimum": 0.5, "maximum": 4}],
  "probes": [{"name": "body", "at": {"nodes": [0]}}],
  "studies": [{"name": "one", "type": "periodic_motion", "frequency": 0.6, "harmonics": 3},
              {"name": "two", "type": "periodic_motion", "frequency": 1.5, "harmonics": 3}]
})";

double pathLengthAt(double omega) { return 0.4 / std::hypot(1 - omega * omega, 0.2 * omega); }
double slopeAt(double omega) { return (pathLengthAt(omega + 1e-6) - pathLengthAt(omega - 1e-6)) / 2e-6; }

const std::string slow = "/studies/0/frequency", fast = "/studies/1/frequency";

}  // namespace

/// The drive's frequency among the parameters of the motion on show.
class TestMotionSession : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    document_ = std::make_unique<document::Document>();
    const QString file = directory_.filePath("oscillator.json");
    QFile written(file);
    QVERIFY(written.open(QIODevice::WriteOnly));
    written.write(text);
    written.close();
    studies_ = std::make_unique<jobs::StudyRunner>(*document_, studyJobs_);
    session_ = std::make_unique<jobs::MotionSession>(*document_, quick_, *studies_);
    QVERIFY(document_->open(file));
    session_->run({"one"});
    QTRY_VERIFY_WITH_TIMEOUT(session_->shown() && !session_->effects().empty(), patience);
  }

  void cleanup() {
    session_.reset();
    studies_.reset();
    document_.reset();
  }

  /// That of another study is none of this motion's.
  void onlyItsOwnFrequencyMovesIt() {
    double ofSlow = 0;
    for (const jobs::ParameterEffect& effect : session_->effects()) {
      QVERIFY(effect.pointer != fast);
      if (effect.pointer == slow) ofSlow = effect.slope;
    }
    QVERIFY2(std::abs(ofSlow / slopeAt(0.6) - 1) < 1e-4, qPrintable(QString::number(ofSlow / slopeAt(0.6))));
    session_->preview(fast, 2);
    QVERIFY(!session_->prediction());
  }

  void dragsArePredicted() {
    session_->preview(slow, 0.61);
    QVERIFY(session_->prediction());
    // To first order in the coefficients, so off by second order.
    QVERIFY(std::abs(session_->predictedAmplitude().value() - pathLengthAt(0.61)) < 1e-3);
    QVERIFY(std::abs(session_->predictedAmplitude().value() - pathLengthAt(0.6)) > 5e-3);
    QCOMPARE(mechanics::Matrix(session_->previewedModel()->massMatrix()),
             mechanics::Matrix(document_->model()->massMatrix()));
    session_->endPreview();
    QVERIFY(!session_->prediction());
  }

  void updateSolvesAtTheFrequencyThatIsSet() {
    QVERIFY(!session_->isStale());
    QVERIFY(document_->setValue(slow, 0.7, "slower"));
    QVERIFY(session_->isStale());
    QVERIFY(session_->isComparable());
    QVERIFY(session_->prediction());
    session_->update();
    QTRY_COMPARE_WITH_TIMEOUT(session_->shown()->motion.omega, 0.7, patience);
    QVERIFY(std::abs(session_->shownAmplitude() - pathLengthAt(0.7)) < 1e-6);
    QVERIFY(!session_->isStale());
    QVERIFY(!session_->prediction());
    document_->undoStack().undo();
    QVERIFY(session_->isStale());
    QVERIFY(session_->prediction());
  }

  void frequenciesOfOtherStudiesStayWhereTheyAre() {
    QVERIFY(document_->setValue(fast, 1.7, "faster"));
    QVERIFY(!session_->isStale());
    QVERIFY(!session_->prediction());
    for (const auto& parameter : document_->model()->parameters)
      if (parameter->pointer() == fast) QCOMPARE(parameter->value(*document_->model()), 1.7);
  }

 private:
  QTemporaryDir directory_;
  std::unique_ptr<document::Document> document_;
  jobs::JobRunner quick_, studyJobs_;
  std::unique_ptr<jobs::StudyRunner> studies_;
  std::unique_ptr<jobs::MotionSession> session_;
};

QTEST_MAIN(TestMotionSession)
#include "test_motion_session.moc"
