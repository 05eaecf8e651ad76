#include <QTest>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"

using namespace pliant::base;

/// What ExecutionContext promises: cancelling sticks, progress lies in [0, 1] and never falls, any thread may call.
class TestExecutionContext : public QObject {
  Q_OBJECT

 private slots:
  void cancellingSticks();
  void progressNeverFalls();
  void rangesJoinComputations();
  void messagesArrive();
  void threadsMayReportAtOnce();
  void cancellingReachesAnotherThread();
  void errorsSayWhere();
  void reportsKnowTheirEnd();
};

void TestExecutionContext::cancellingSticks() {
  ExecutionContext context;
  QVERIFY(!context.cancelRequested());
  context.requestCancel();
  QVERIFY(context.cancelRequested());
  context.reportProgress(1);
  context.setRange(0, 1);
  QVERIFY(context.cancelRequested());
}

void TestExecutionContext::progressNeverFalls() {
  std::vector<double> seen;
  ExecutionContext context([&](double fraction, const std::string&) { seen.push_back(fraction); });
  for (const double fraction : {0.2, 0.1, std::nan(""), -3.0, 0.5, 0.4, 7.0, 0.6}) context.reportProgress(fraction);
  QCOMPARE(context.progress(), 1.0);
  QVERIFY(!seen.empty());
  double latest = 0;
  for (const double fraction : seen) {
    QVERIFY(fraction >= latest && fraction <= 1);
    latest = fraction;
  }
}

void TestExecutionContext::rangesJoinComputations() {
  ExecutionContext context;
  context.setRange(0, 0.25);
  context.reportProgress(1);
  QCOMPARE(context.progress(), 0.25);
  context.setRange(0.25, 1);
  context.reportProgress(0);
  QCOMPARE(context.progress(), 0.25);
  context.reportProgress(0.5);
  QCOMPARE(context.progress(), 0.625);
  context.setRange(-1, 5);
  context.reportProgress(1);
  QCOMPARE(context.progress(), 1.0);
}

void TestExecutionContext::messagesArrive() {
  std::string message, logged;
  Severity severity = Severity::information;
  ExecutionContext context([&](double, const std::string& text) { message = text; },
                           [&](Severity kind, const std::string& text) {
                             severity = kind;
                             logged = text;
                           });
  context.reportProgress(0.5, "half");
  context.log(Severity::warning, "careful");
  QCOMPARE(message, std::string("half"));
  QCOMPARE(logged, std::string("careful"));
  QVERIFY(severity == Severity::warning);
}

void TestExecutionContext::threadsMayReportAtOnce() {
  std::atomic<int> inside{0};
  bool overlapped = false, fell = false;
  double latest = 0;
  int calls = 0;
  ExecutionContext context([&](double fraction, const std::string&) {
    overlapped = overlapped || inside.fetch_add(1) != 0;
    fell = fell || fraction < latest;
    latest = fraction;
    ++calls;
    inside.fetch_sub(1);
  });
  constexpr int steps = 2000;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i <= steps; ++i) context.reportProgress(static_cast<double>(i) / steps);
    });
  double before = 0;
  bool readingsFell = false;
  for (int i = 0; i < 1000; ++i) {
    const double now = context.progress();
    readingsFell = readingsFell || now < before;
    before = now;
  }
  for (std::thread& thread : threads) thread.join();
  QVERIFY(!overlapped);
  QVERIFY(!fell && !readingsFell);
  QVERIFY(calls > 0);
  QCOMPARE(context.progress(), 1.0);
}

void TestExecutionContext::cancellingReachesAnotherThread() {
  ExecutionContext context;
  std::thread worker([&] {
    while (!context.cancelRequested()) std::this_thread::yield();
  });
  context.requestCancel();
  worker.join();
  QVERIFY(context.cancelRequested());
}

void TestExecutionContext::errorsSayWhere() {
  const InputError bare("", "the mass is negative");
  QCOMPARE(std::string(bare.what()), std::string("the mass is negative"));
  const InputError placed = bare.inside("/point_masses/0/mass").inside("fork.json");
  QCOMPARE(placed.location(), std::string("fork.json: /point_masses/0/mass"));
  QCOMPARE(placed.problem(), std::string("the mass is negative"));
  QCOMPARE(std::string(placed.what()), std::string("fork.json: /point_masses/0/mass: the mass is negative"));
}

void TestExecutionContext::reportsKnowTheirEnd() {
  SolverReport report;
  QVERIFY(!report.converged());
  QCOMPARE(report.residual(), 0.0);
  report.iterations = {{0, 1.0, 0}, {1, 1e-3, 1}};
  report.termination = TerminationType::converged;
  QVERIFY(report.converged());
  QCOMPARE(report.residual(), 1e-3);
  const std::pair<TerminationType, std::string_view> names[] = {{TerminationType::converged, "converged"},
                                                                {TerminationType::iterationLimit, "iteration limit"},
                                                                {TerminationType::infeasible, "infeasible"},
                                                                {TerminationType::cancelled, "cancelled"},
                                                                {TerminationType::failed, "failed"}};
  for (const auto& [termination, name] : names) QVERIFY(toString(termination) == name);
}

QTEST_GUILESS_MAIN(TestExecutionContext)
#include "test_execution_context.moc"
