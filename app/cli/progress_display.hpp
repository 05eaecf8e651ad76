#pragma once

#include <string>

#include "core/base/execution_context.hpp"

namespace pliant::cli {

/// Shows on standard error how far a computation is: a bar that is redrawn on a terminal, a line every tenth elsewhere.
class ProgressDisplay {
 public:
  ProgressDisplay();

  /// Safe from any thread that ExecutionContext calls from (it serialises its calls).
  void show(double fraction, const std::string& message);
  void log(base::Severity severity, const std::string& message);
  /// Removes the bar, so that other text can follow.
  void clear();

 private:
  bool isTerminal_;
  int lastShown_ = -1;  ///< per cent
};

/// While it lives, Ctrl-C and SIGTERM cancel `context`; a second one ends the program at once.
class CancelOnInterrupt {
 public:
  explicit CancelOnInterrupt(base::ExecutionContext& context);
  ~CancelOnInterrupt();
  CancelOnInterrupt(const CancelOnInterrupt&) = delete;
  CancelOnInterrupt& operator=(const CancelOnInterrupt&) = delete;
};

}  // namespace pliant::cli
