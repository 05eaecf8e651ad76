#include <QProgressBar>
#include <QTest>
#include <QThread>
#include <QToolButton>
#include <atomic>

#include "ui/shell/job_status.hpp"

using namespace pliant;
using jobs::Delivery;
using jobs::JobRunner;
using shell::JobStatus;

/// What the status bar tells of jobs that run at the same time.
class TestJobStatus : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    release_ = false;
    status_ = std::make_unique<JobStatus>();
    studies_ = std::make_unique<JobRunner>();
    quick_ = std::make_unique<JobRunner>();
    status_->watch(*studies_);
    status_->watch(*quick_);
    status_->show();
  }

  void cleanup() {
    release_ = true;
    quick_.reset();
    studies_.reset();
    status_.reset();
  }

  void aQuickJobDoesNotHideAStudy() {
    submit(*studies_, "response", true);
    QTRY_COMPARE(status_->text(), QString("response: half"));
    submit(*quick_, "Motion at 3 rad/s", false);
    QTRY_VERIFY(quick_->isIdle());
    QCOMPARE(status_->text(), QString("response: half"));
    QCOMPARE(bar()->value(), 500);
    QVERIFY(bar()->isVisible());
    QVERIFY(cancelButton()->isVisible());
    release_ = true;
    QTRY_VERIFY(status_->text().startsWith("response: done in"));
    QVERIFY(!bar()->isVisible());
    QVERIFY(!cancelButton()->isVisible());
  }

  void aStudyTakesThePlaceOfAQuickJobAndGivesItBack() {
    submit(*quick_, "Motion at 3 rad/s", true);
    QTRY_COMPARE(status_->text(), QString("Motion at 3 rad/s: half"));
    submit(*studies_, "response", false);
    QTRY_VERIFY(studies_->isIdle());
    QCOMPARE(status_->text(), QString("Motion at 3 rad/s: half"));
    QVERIFY(cancelButton()->isVisible());
  }

  void workThatNobodyAskedForIsNotShown() {
    submit(*quick_, "", false);
    QTRY_VERIFY(quick_->isIdle());
    QCOMPARE(status_->text(), QString("Ready"));
    QVERIFY(!bar()->isVisible());
  }

 private:
  void submit(JobRunner& runner, const QString& title, bool held) {
    runner.submit({title, title, [this, held](base::ExecutionContext& context, const jobs::Publish&) -> Delivery {
                     context.reportProgress(0.5, "half");
                     while (held && !release_ && !context.cancelRequested()) QThread::msleep(1);
                     return {};
                   }});
  }
  QProgressBar* bar() { return status_->findChild<QProgressBar*>(); }
  QToolButton* cancelButton() { return status_->findChild<QToolButton*>(); }

  std::atomic<bool> release_{false};
  std::unique_ptr<JobStatus> status_;
  std::unique_ptr<JobRunner> studies_;
  std::unique_ptr<JobRunner> quick_;
};

QTEST_MAIN(TestJobStatus)
#include "test_job_status.moc"
