#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/harmonic/floquet_stability.hpp"
#include "core/harmonic/response_point.hpp"
#include "core/solvers/continuation_solver.hpp"

namespace pliant::harmonic {

/// A point of a curve with what is special about it.
struct TrackedPoint {
  solvers::BranchPoint at;
  PointKind kind = PointKind::regular;
  int probe = -1;  ///< of a peak
  Stability stability;
};

/// Finds the stability of the points of a curve as they come, and the bifurcations between them: wherever the number of
/// unstable multipliers changes, the point is located where the multiplier that changes sides is on the unit circle.
/// A multiplier that passes +1 between points with a fold among them does so at the fold; elsewhere it is a branch
/// point. Two changes that undo one another between two points are not seen.
class StabilityTracker {
 public:
  struct Functions {
    std::function<Stability(const solvers::BranchPoint&)> stability;
    /// The point of the curve at an arc length between those of two others.
    std::function<std::optional<solvers::BranchPoint>(const solvers::BranchPoint&, const solvers::BranchPoint&, double)>
        between;
    /// Gets the points in their order; folds wait until the stability beyond them is known.
    std::function<void(TrackedPoint&&)> emit;
  };

  /// `tolerance`: relative error of the frequency of a bifurcation.
  StabilityTracker(Functions functions, double tolerance);

  void add(const solvers::BranchPoint& point, PointKind kind, int probe);
  /// Emits what still waits.
  void finish();

 private:
  using Points = std::vector<TrackedPoint>;

  TrackedPoint regularPoint(const solvers::BranchPoint& at) const;
  void addBifurcations(const TrackedPoint& from, const TrackedPoint& to, Points& into) const;
  std::optional<TrackedPoint> locate(const TrackedPoint& from, const TrackedPoint& to, std::size_t index) const;
  void addBifurcationsAroundFold(const TrackedPoint& from, const TrackedPoint& to, const TrackedPoint& fold,
                                 Points& into) const;

  Functions functions_;
  double tolerance_;
  std::optional<TrackedPoint> last_;
  Points folds_;  ///< since the last point
};

}  // namespace pliant::harmonic
