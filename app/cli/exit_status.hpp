#pragma once

namespace pliant::cli {

/// What the program returns to the shell.
enum ExitStatus {
  done = 0,
  notConverged = 1,  ///< or the machine failed: no memory, no renderer
  wrongInput = 2,
  cancelled = 130,
};

}  // namespace pliant::cli
