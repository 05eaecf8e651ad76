#pragma once

#include <functional>

namespace pliant::math {

/// Calls `body(i)` for i = 0 .. count-1, spread over the threads. The body must not care about the order: results are
/// deterministic only if different i write to different places.
void parallelFor(int count, const std::function<void(int)>& body);

/// The largest number of threads that parallelFor and the linear solvers use from now on (0: all cores).
void setThreadCount(int threads);
int threadCount();

}  // namespace pliant::math
