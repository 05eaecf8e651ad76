#include "core/base/execution_context.hpp"

#include <algorithm>

namespace pliant::base {

ExecutionContext::ExecutionContext(ProgressCallback onProgress, LogCallback onLog)
    : onProgress_(std::move(onProgress)), onLog_(std::move(onLog)) {}

void ExecutionContext::reportProgress(double fraction, std::string_view message) {
  const std::lock_guard lock(mutex_);
  if (!(fraction >= 0.0)) return;
  const double whole = rangeBegin_ + (rangeEnd_ - rangeBegin_) * std::min(fraction, 1.0);
  const double latest = std::max(whole, progress_.load());
  progress_.store(latest, std::memory_order_release);
  if (onProgress_) onProgress_(latest, std::string(message));
}

void ExecutionContext::setRange(double begin, double end) {
  const std::lock_guard lock(mutex_);
  rangeBegin_ = std::clamp(begin, 0.0, 1.0);
  rangeEnd_ = std::clamp(end, rangeBegin_, 1.0);
}

void ExecutionContext::log(Severity severity, const std::string& message) {
  const std::lock_guard lock(mutex_);
  if (onLog_) onLog_(severity, message);
}

}  // namespace pliant::base
