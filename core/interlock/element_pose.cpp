#include "core/interlock/element_pose.hpp"

namespace pliant::interlock {

ElementPose::ElementPose(const ElementParts& parts, const Eigen::Vector3d& place, const Eigen::Matrix3d& turn)
    : position(place), rotation(turn), corners(turn * parts.corners()), centres(turn * parts.centres()) {
  curves.reserve(parts.curves().size());
  for (const ClosedCurve& curve : parts.curves()) curves.push_back(curve.rotated(turn));
}

PlacedPart ElementPose::part(const ElementParts& parts, int number) const {
  const Part& own = parts.parts()[static_cast<std::size_t>(number)];
  PlacedPart result{&own, own.kind == PartKind::arc ? &curves[static_cast<std::size_t>(own.curve)] : nullptr, {}};
  for (int i = 0; i < 3; ++i) result.corners.col(i) = corners.col(own.corners[static_cast<std::size_t>(i)]);
  return result;
}

void appendNearParts(const ElementParts& first, const Eigen::Matrix3Xd& firstCentres, const ElementParts& second,
                     const Eigen::Matrix3Xd& secondCentres, const Eigen::Vector3d& offset, double reach,
                     std::vector<std::array<int, 2>>& pairs) {
  thread_local std::vector<std::array<int, 2>> stack;
  stack.assign(1, {0, 0});
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const ElementParts::Node &nodeA = first.nodes()[static_cast<std::size_t>(i)],
                             &nodeB = second.nodes()[static_cast<std::size_t>(j)];
    const double touching = nodeA.ball.radius + nodeB.ball.radius + reach;
    if ((firstCentres.col(i) + offset - secondCentres.col(j)).squaredNorm() >= touching * touching) continue;
    if (nodeA.part >= 0 && nodeB.part >= 0) {
      if (countsAsContact(first.parts()[static_cast<std::size_t>(nodeA.part)],
                          second.parts()[static_cast<std::size_t>(nodeB.part)]))
        pairs.push_back({nodeA.part, nodeB.part});
    } else if (nodeB.part >= 0 || (nodeA.part < 0 && nodeA.ball.radius > nodeB.ball.radius)) {
      for (const int child : nodeA.children) stack.push_back({child, j});
    } else {
      for (const int child : nodeB.children) stack.push_back({i, child});
    }
  }
}

}  // namespace pliant::interlock
