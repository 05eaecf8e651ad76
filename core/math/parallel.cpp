#include "core/math/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace pliant::math {

namespace {

std::mutex limitMutex;
std::unique_ptr<tbb::global_control> limit;
std::atomic<int> limitedThreads{0};

}  // namespace

void parallelFor(int count, const std::function<void(int)>& body) {
  if (count <= 1 || threadCount() == 1) {
    for (int i = 0; i < count; ++i) body(i);
    return;
  }
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(
        0, count, [&](int i) { body(i); }, tbb::simple_partitioner());
  });
}

void setThreadCount(int threads) {
  if (threads < 0) throw std::invalid_argument("the number of threads is negative");
  const std::lock_guard lock(limitMutex);
  limit.reset();
  if (threads > 0) {
    limit = std::make_unique<tbb::global_control>(
        tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  limitedThreads = threads;
}

int threadCount() {
  const int threads = limitedThreads;
  return threads > 0 ? threads : tbb::info::default_concurrency();
}

}  // namespace pliant::math
