#include <QSignalSpy>
#include <QTest>
#include <QThread>
#include <atomic>
#include <memory>

#include "core/base/error.hpp"
#include "ui/jobs/job_runner.hpp"

using namespace pliant;
using jobs::Delivery;
using jobs::JobOutcome;
using jobs::JobRunner;

class TestJobRunner : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { qRegisterMetaType<JobOutcome>(); }
  void deliversOnTheOwnersThread();
  void newestOfATopicWins();
  void topicsDoNotDisturbOneAnother();
  void aCancelledJobDeliversWhatItHas();
  void aWaitingJobIsDroppedByCancel();
  void progressNeverFalls();
  void onlyTheNewestSnapshotIsCalled();
  void anInputErrorBecomesASentence();
  void nothingIsCalledAfterDestruction();

 private:
  static bool waitUntilCancelled(const base::ExecutionContext& context) {
    for (int i = 0; i < 5000 && !context.cancelRequested(); ++i) QThread::msleep(1);
    return context.cancelRequested();
  }
};

void TestJobRunner::deliversOnTheOwnersThread() {
  JobRunner runner;
  QThread* worker = nullptr;
  QThread* receiver = nullptr;
  runner.submit({"a", "A", [&](base::ExecutionContext&, const jobs::Publish&) -> Delivery {
                   worker = QThread::currentThread();
                   return [&] { receiver = QThread::currentThread(); };
                 }});
  QTRY_VERIFY(receiver != nullptr);
  QCOMPARE(receiver, thread());
  QVERIFY(worker != thread());
  QVERIFY(runner.isIdle());
}

void TestJobRunner::newestOfATopicWins() {
  JobRunner runner;
  std::atomic<bool> firstSawCancel{false};
  QList<int> delivered;
  std::atomic<bool> firstRuns{false};
  runner.submit({"solve", "first", [&](base::ExecutionContext& context, const jobs::Publish& publish) -> Delivery {
                   publish([&] { delivered << 10; });
                   firstRuns = true;
                   firstSawCancel = waitUntilCancelled(context);
                   return [&] { delivered << 1; };
                 }});
  QTRY_VERIFY(firstRuns);
  for (int i = 2; i <= 5; ++i)
    runner.submit({"solve", "later", [&, i](base::ExecutionContext&, const jobs::Publish&) -> Delivery {
                     return [&, i] { delivered << i; };
                   }});
  QTRY_VERIFY(runner.isIdle());
  QVERIFY(firstSawCancel);
  delivered.removeAll(10);  // a snapshot may have been taken before it was superseded
  QCOMPARE(delivered, QList<int>{5});
}

void TestJobRunner::topicsDoNotDisturbOneAnother() {
  JobRunner runner;
  QList<int> delivered;
  for (int i = 0; i < 4; ++i)
    runner.submit(
        {QString::number(i), "job", [&, i](base::ExecutionContext& context, const jobs::Publish&) -> Delivery {
           return [&, i, cancelled = context.cancelRequested()] { delivered << (cancelled ? -1 : i); };
         }});
  QTRY_VERIFY(runner.isIdle());
  QCOMPARE(delivered, (QList<int>{0, 1, 2, 3}));
}

void TestJobRunner::aCancelledJobDeliversWhatItHas() {
  JobRunner runner;
  QSignalSpy finished(&runner, &JobRunner::finished);
  std::atomic<bool> runs{false};
  int half = 0;
  const auto id =
      runner.submit({"curve", "Tracing", [&](base::ExecutionContext& context, const jobs::Publish&) -> Delivery {
                       runs = true;
                       waitUntilCancelled(context);
                       return [&] { half = 50; };
                     }});
  QTRY_VERIFY(runs);
  runner.cancel(id);
  QTRY_COMPARE(finished.count(), 1);
  QCOMPARE(half, 50);
  QCOMPARE(finished[0][2].value<JobOutcome>(), JobOutcome::cancelled);
}

void TestJobRunner::aWaitingJobIsDroppedByCancel() {
  JobRunner runner;
  QSignalSpy finished(&runner, &JobRunner::finished);
  std::atomic<bool> release{false};
  bool ran = false;
  runner.submit({"first", "first", [&](base::ExecutionContext&, const jobs::Publish&) -> Delivery {
                   while (!release) QThread::msleep(1);
                   return {};
                 }});
  const auto waiting =
      runner.submit({"second", "second", [&](base::ExecutionContext&, const jobs::Publish&) -> Delivery {
                       ran = true;
                       return {};
                     }});
  QVERIFY(runner.isActive("second"));
  runner.cancel(waiting);
  QVERIFY(!runner.isActive("second"));
  release = true;
  QTRY_VERIFY(runner.isIdle());
  QVERIFY(!ran);
  QCOMPARE(finished.count(), 2);
}

void TestJobRunner::progressNeverFalls() {
  JobRunner runner;
  QSignalSpy progressed(&runner, &JobRunner::progressed);
  runner.submit({"a", "A", [](base::ExecutionContext& context, const jobs::Publish&) -> Delivery {
                   for (const double fraction : {0.1, 0.5, 0.3, 0.9, 0.2, 1.0}) {
                     context.reportProgress(fraction, "step");
                     QThread::msleep(5);
                   }
                   return {};
                 }});
  QTRY_VERIFY(runner.isIdle());
  QVERIFY(!progressed.isEmpty());
  double last = 0;
  for (const auto& signal : progressed) {
    QVERIFY(signal[1].toDouble() >= last);
    last = signal[1].toDouble();
  }
  QCOMPARE(last, 1.0);
}

void TestJobRunner::onlyTheNewestSnapshotIsCalled() {
  JobRunner runner;
  std::atomic<bool> published{false};
  std::atomic<bool> release{false};
  QList<int> seen;
  runner.submit({"a", "A", [&](base::ExecutionContext&, const jobs::Publish& publish) -> Delivery {
                   for (int i = 0; i < 1000; ++i) publish([&seen, i] { seen << i; });
                   published = true;
                   while (!release) QThread::msleep(1);
                   return {};
                 }});
  while (!published) QThread::msleep(1);  // the event loop stands still meanwhile
  QTRY_VERIFY(!seen.isEmpty());
  release = true;
  QTRY_VERIFY(runner.isIdle());
  QCOMPARE(seen, QList<int>{999});
}

void TestJobRunner::anInputErrorBecomesASentence() {
  JobRunner runner;
  QSignalSpy finished(&runner, &JobRunner::finished);
  runner.submit({"a", "A", [](base::ExecutionContext&, const jobs::Publish&) -> Delivery {
                   throw base::InputError("/masses/0", "The mass is -1 kg, but it must not be negative.");
                 }});
  QTRY_COMPARE(finished.count(), 1);
  QCOMPARE(finished[0][2].value<JobOutcome>(), JobOutcome::failed);
  QCOMPARE(finished[0][3].toString(), QString("/masses/0: The mass is -1 kg, but it must not be negative."));
}

void TestJobRunner::nothingIsCalledAfterDestruction() {
  bool called = false;
  {
    JobRunner runner;
    std::atomic<bool> runs{false};
    runner.submit({"a", "A", [&](base::ExecutionContext& context, const jobs::Publish&) -> Delivery {
                     runs = true;
                     waitUntilCancelled(context);
                     return [&] { called = true; };
                   }});
    while (!runs) QThread::msleep(1);
  }
  QCoreApplication::processEvents();
  QVERIFY(!called);
}

QTEST_GUILESS_MAIN(TestJobRunner)
#include "test_job_runner.moc"
