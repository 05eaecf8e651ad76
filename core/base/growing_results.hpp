#pragma once

#include <algorithm>
#include <functional>
#include <mutex>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/base/stopwatch.hpp"

namespace pliant::base {

/// Results that several threads find in any order, of which an observer sees copies: at most 20 times a second, and
/// less often where copying takes long.
template <class Item>
class GrowingResults {
 public:
  using Observer = std::function<void(const std::vector<Item>&)>;

  /// `count` are to be put into `items`; progress goes to `context`. All of them must outlive this; the observer may
  /// be empty.
  GrowingResults(std::vector<Item>& items, int count, ExecutionContext& context, const Observer& observe)
      : items_(items), count_(count), context_(context), observe_(observe) {}

  /// Calls `put(items)`, which must be quick, from any thread but never from two at once.
  template <class Put>
  void add(const Put& put) {
    const std::lock_guard lock(mutex_);
    put(items_);
    context_.reportProgress(static_cast<double>(++done_) / count_);
    const double now = watch_.seconds();
    if (!observe_ || now < next_) return;
    observe_(items_);
    next_ = watch_.seconds() + std::max(0.05, 50 * (watch_.seconds() - now));
  }

 private:
  std::vector<Item>& items_;
  const int count_;
  ExecutionContext& context_;
  const Observer& observe_;
  std::mutex mutex_;
  Stopwatch watch_;
  int done_ = 0;
  double next_ = 0;
};

}  // namespace pliant::base
