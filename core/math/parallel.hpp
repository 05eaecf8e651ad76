#pragma once

#include <functional>

namespace pliant::math {

/// Calls `body(i)` for i = 0 .. count-1, spread over the threads. The body must not care about the order: results are
/// deterministic only if different i write to different places. Calls may be nested and may come from several threads
/// at once; a body that waits for a nested call never starts another body of the outer one, so thread-local workspaces
/// are safe. The first exception thrown by a body is passed on to the caller.
void parallelFor(int count, const std::function<void(int)>& body);

/// The largest number of threads that parallelFor and the linear solvers use from now on (0: all cores).
/// Throws std::invalid_argument if `threads` is negative.
void setThreadCount(int threads);
int threadCount();

}  // namespace pliant::math
