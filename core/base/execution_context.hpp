#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace pliant::base {

enum class Severity { information, warning };

/// Progress, cancellation and messages of one computation. Every member may be called from any thread.
/// Promises: cancellation is sticky (once requested it stays); progress lies in [0, 1] and never falls.
class ExecutionContext {
 public:
  using ProgressCallback = std::function<void(double fraction, const std::string& message)>;
  using LogCallback = std::function<void(Severity, const std::string& message)>;

  ExecutionContext() = default;
  explicit ExecutionContext(ProgressCallback onProgress, LogCallback onLog = {});
  ExecutionContext(const ExecutionContext&) = delete;
  ExecutionContext& operator=(const ExecutionContext&) = delete;

  void requestCancel() noexcept { cancelled_.store(true, std::memory_order_release); }
  bool cancelRequested() const noexcept { return cancelled_.load(std::memory_order_acquire); }

  /// Reports that `fraction` of the current range is done. NaN and steps back are ignored; calls are serialised.
  void reportProgress(double fraction, std::string_view message = {});
  double progress() const noexcept { return progress_.load(std::memory_order_acquire); }

  /// Maps the fractions reported from now on into [begin, end] of the whole, for one computation made of several.
  void setRange(double begin, double end);

  void log(Severity severity, const std::string& message);

 private:
  std::atomic<bool> cancelled_{false};
  std::atomic<double> progress_{0.0};
  double rangeBegin_ = 0.0;
  double rangeEnd_ = 1.0;
  std::mutex mutex_;
  ProgressCallback onProgress_;
  LogCallback onLog_;
};

}  // namespace pliant::base
