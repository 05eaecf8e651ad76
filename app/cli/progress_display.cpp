#include "app/cli/progress_display.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <iostream>

namespace pliant::cli {

ProgressDisplay::ProgressDisplay() : isTerminal_(::isatty(STDERR_FILENO) != 0) {}

void ProgressDisplay::show(double fraction, const std::string& message) {
  constexpr int width = 30;
  const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
  if (!isTerminal_) {
    if (percent / 10 <= lastShown_ / 10 && lastShown_ >= 0) return;
    std::cerr << percent << " %" << (message.empty() ? "" : "  ") << message << std::endl;
  } else {
    const int filled = percent * width / 100;
    std::cerr << "\r[" << std::string(static_cast<std::size_t>(filled), '#')
              << std::string(static_cast<std::size_t>(width - filled), '-') << "] " << percent << " %  "
              << message.substr(0, 60) << "\033[K" << std::flush;
  }
  lastShown_ = percent;
}

void ProgressDisplay::log(base::Severity severity, const std::string& message) {
  clear();
  std::cerr << (severity == base::Severity::warning ? "warning: " : "") << message << std::endl;
}

void ProgressDisplay::clear() {
  if (isTerminal_ && lastShown_ >= 0) std::cerr << "\r\033[K" << std::flush;
}

namespace {

std::atomic<base::ExecutionContext*> interrupted{nullptr};
static_assert(std::atomic<base::ExecutionContext*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "a signal handler may use nothing else");

void handle(int signal) {
  if (base::ExecutionContext* context = interrupted.load()) context->requestCancel();
  std::signal(signal, SIG_DFL);
}

}  // namespace

CancelOnInterrupt::CancelOnInterrupt(base::ExecutionContext& context) {
  interrupted = &context;
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
}

CancelOnInterrupt::~CancelOnInterrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  interrupted = nullptr;
}

}  // namespace pliant::cli
