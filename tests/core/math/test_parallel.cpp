#include <QTest>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/math/parallel.hpp"

using namespace pliant::math;

class ParallelTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { setThreadCount(0); }

  void visitsEveryIndexOnce() {
    for (const int threads : {1, 2, 5}) {
      setThreadCount(threads);
      QCOMPARE(threadCount(), threads);
      for (const int count : {0, 1, 2, 1000}) {
        std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
        parallelFor(count, [&](int i) { ++visits[static_cast<std::size_t>(i)]; });
        for (const auto& visit : visits) QCOMPARE(visit.load(), 1);
      }
    }
  }

  void defaultsToAllCores() {
    QVERIFY(threadCount() >= 1);
    QVERIFY_THROWS_EXCEPTION(std::invalid_argument, setThreadCount(-1));
  }

  void oneThreadStaysOnTheCaller() {
    setThreadCount(1);
    const auto caller = std::this_thread::get_id();
    std::atomic<bool> elsewhere{false};
    parallelFor(64, [&](int) { elsewhere = elsewhere || std::this_thread::get_id() != caller; });
    QVERIFY(!elsewhere);
  }

  void nestedCallsKeepThreadLocalWorkspaces() {
    setThreadCount(4);
    std::atomic<bool> reentered{false};
    parallelFor(64, [&](int) {
      thread_local int depth = 0;
      if (depth != 0) reentered = true;
      ++depth;
      std::atomic<int> sum{0};
      parallelFor(16, [&](int i) { sum += i; });
      if (sum != 120) reentered = true;
      --depth;
    });
    QVERIFY(!reentered);
  }

  void exceptionsReachTheCaller() {
    for (const int threads : {1, 3}) {
      setThreadCount(threads);
      QVERIFY_THROWS_EXCEPTION(std::runtime_error, parallelFor(100, [](int i) {
                                 if (i == 37) throw std::runtime_error("body");
                               }));
    }
  }

  void severalCallersAtOnce() {
    setThreadCount(2);
    std::atomic<long> total{0};
    std::vector<std::thread> callers;
    for (int caller = 0; caller < 4; ++caller) {
      callers.emplace_back([&] {
        for (int repeat = 0; repeat < 50; ++repeat) parallelFor(100, [&](int i) { total += i; });
      });
    }
    for (auto& caller : callers) caller.join();
    QCOMPARE(total.load(), 4L * 50L * 4950L);
  }
};

QTEST_GUILESS_MAIN(ParallelTest)
#include "test_parallel.moc"
