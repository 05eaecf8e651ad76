#include "core/mechanics/body_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace pliant::mechanics {

namespace {

Eigen::Matrix3d rotationBy(const Eigen::Vector3d& rotation) {
  const double angle = rotation.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
}

}  // namespace

Eigen::Matrix3Xd Placement::apply(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& centre) const {
  return (rotation * (points.colwise() - centre)).colwise() + (centre + translation);
}

Placement placementAt(const std::vector<Keyframe>& path, double time) {
  if (path.empty()) return {};
  const auto after =
      std::find_if(path.begin(), path.end(), [&](const Keyframe& keyframe) { return keyframe.time > time; });
  if (after == path.begin()) return {path.front().translation, rotationBy(path.front().rotation)};
  if (after == path.end()) return {path.back().translation, rotationBy(path.back().rotation)};
  const Keyframe& before = *(after - 1);
  const double fraction = (time - before.time) / (after->time - before.time);
  return {before.translation + fraction * (after->translation - before.translation),
          rotationBy(before.rotation + fraction * (after->rotation - before.rotation))};
}

}  // namespace pliant::mechanics
