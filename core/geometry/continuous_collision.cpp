#include "core/geometry/continuous_collision.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pliant::geometry {

namespace {

constexpr double keptShare = 0.1;      // of the gap: what an advance leaves, and what ends the search
constexpr int largestAdvances = 1000;  // any fraction reached on the way is safe

/// After which time at the earliest the gap along the unit vector n can have shrunk to keptShare of what it is now, if
/// all corners move on with their velocities.
double advanceAlong(const Eigen::Vector3d& n, SimplexPair pair, const Corners& now, const Corners& velocity,
                    double separation) {
  const double infinity = std::numeric_limits<double>::infinity();
  double lowestA = infinity, highestB = -infinity, speedA = -infinity, speedB = -infinity;
  for (int i = 0; i < cornerCount(pair); ++i) {
    // Relative to a corner, since coordinates may be large against distances.
    const double place = n.dot(now.col(i) - now.col(0)), speed = n.dot(velocity.col(i));
    if (i < firstCornerCount(pair)) {
      lowestA = std::min(lowestA, place);
      speedA = std::max(speedA, -speed);
    } else {
      highestB = std::max(highestB, place);
      speedB = std::max(speedB, speed);
    }
  }
  const double gap = lowestA - highestB - separation, approach = speedA + speedB;
  if (!(gap > 0)) return 0;
  return approach > 0 ? (1 - keptShare) * gap / approach : infinity;
}

}  // namespace

double safeFraction(SimplexPair pair, const Corners& corners, const Corners& motion, double separation, double limit,
                    double keptGap) {
  const int count = cornerCount(pair);
  if (!corners.leftCols(count).allFinite() || !motion.leftCols(count).allFinite() || !std::isfinite(separation))
    return 0;
  Corners now = Corners::Zero(), velocity = Corners::Zero();
  double time = 0;
  // What all corners have in common changes no distance, but would be rounded.
  const Eigen::Vector3d common = motion.leftCols(count).rowwise().mean();
  velocity.leftCols(count) = motion.leftCols(count).colwise() - common;
  for (int advance = 0; advance < largestAdvances; ++advance) {
    now.leftCols(count) = corners.leftCols(count) + time * velocity.leftCols(count);
    const ClosestPoints closest = closestPoints(pair, now);
    const double gap = std::sqrt(closest.squaredDistance) - separation;
    if (advance == 0) {
      if (!(gap > 0)) return 0;
      keptGap = std::min(keptGap, keptShare * gap);
    } else if (gap <= keptGap) {
      return time;
    }
    const double step = advanceAlong(directionBetween(now, closest), pair, now, velocity, separation);
    if (!(time + step < limit)) return limit;
    if (!(step > 0)) return time;
    time += step;
  }
  return time;
}

}  // namespace pliant::geometry
