#pragma once

#include <algorithm>
#include <functional>

#include "core/interlock/cell_contact.hpp"
#include "core/interlock/element_pose.hpp"
#include "core/interlock/sheet_detail.hpp"
#include "core/math/parallel.hpp"

namespace pliant::interlock {

/// body(i) for i = 0 .. count-1, in any order, from several threads.
inline void forElements(int count, const std::function<void(int)>& body) {
  constexpr int chunk = 64;
  math::parallelFor((count + chunk - 1) / chunk, [&](int k) {
    for (int i = k * chunk; i < std::min(count, (k + 1) * chunk); ++i) body(i);
  });
}

/// Of twice the sum of two radii: how far a pair may move in a step, see CellSolver.
inline constexpr double pairMove = 0.9;

/// One run of SheetDetailer::follow. Elements are numbered as in SheetDetailer::elements.
class DetailSearch {
 public:
  DetailSearch(const SheetDetailer& detailer, const std::vector<Eigen::Matrix3Xd>& path);

  SheetDetail run(base::ExecutionContext& context);

 private:
  using Frame = SheetShape::Frame;
  struct Pair {
    int a, b;
    double gap;  ///< before the step, or the range
  };

  const ElementParts& partsOf(int element) const { return detailer_.parts_[shapeOf(element)]; }
  std::size_t shapeOf(int element) const;
  double radiusOf(int element) const { return detailer_.radii_[shapeOf(element)]; }
  int count() const { return static_cast<int>(poses_.size()); }

  /// Where the sheet wants the elements at a place of the path, from 0 to 1.
  std::vector<Frame> targetsAt(double progress) const;
  /// All pairs that can meet while no element moves farther than `margin` [m].
  void findPairs(double margin);
  /// The smallest gap of two elements, if below `reach`, else `reach`; negative if they overlap.
  double gapBetweenElements(int a, const ElementPose& poseA, int b, const ElementPose& poseB, double reach) const;
  /// A bound of how far any place of `a` moves as seen from `b`.
  double relativeMove(int a, const ElementPose& nextA, int b, const ElementPose& nextB) const;

  /// Carries all elements with the sheet to these targets; false if the step is too long, or more than `mostJammed` of
  /// all elements would have to be carried as one with others.
  bool carry(const std::vector<Frame>& next, double mostJammed);
  bool isAllowed(const Pair& pair, const std::vector<ElementPose>& next) const;
  /// Moves each element that can gain by it; returns the farthest move [m].
  double sweep();
  /// The same of one element.
  double relax(int element);
  /// The pull and all contacts of one element at a pose of its own; infinite if it overlaps another.
  double energyOf(int element, const ElementPose& pose, Eigen::Matrix<double, 6, 1>* gradient,
                  Eigen::Matrix<double, 6, 6>* hessian) const;
  void colour();

  const SheetDetailer& detailer_;
  const std::vector<Eigen::Matrix3Xd>& path_;
  double radius_, range_, reach_;
  std::vector<ElementPose> poses_;
  std::vector<Frame> targets_;
  std::vector<Pair> pairs_;
  std::vector<std::vector<int>> neighbours_;  ///< per element the pairs it is in
  std::vector<std::vector<int>> colours_;     ///< elements no two of which are a pair
  std::vector<char> awake_;                   ///< elements that may gain by moving: they or their neighbours have moved
  long jams_ = 0;
};

}  // namespace pliant::interlock
