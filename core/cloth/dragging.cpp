#include "core/cloth/dragging.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace pliant::cloth {

namespace {

constexpr double extentsPerSecond = 4;
constexpr int mostRefusals = 4;
constexpr double givingWay = -0.125;  // of the reach of one step
constexpr double arrived = 1e-9;      // of the reach of one step

}  // namespace

Dragging::Dragging(ClothSimulation& simulation) : simulation_(simulation) {
  const auto rest = simulation.problem().model->restPositions.reshaped(3, simulation.problem().model->nodeCount());
  const double extent = (rest.rowwise().maxCoeff() - rest.rowwise().minCoeff()).norm();
  reach_ = extentsPerSecond * extent * simulation.options().timeStep;
}

void Dragging::pull(int node, const Eigen::Vector3d& hand) {
  if (node < 0 || node >= simulation_.state().positions.cols())
    throw base::InputError("", "there is no node " + std::to_string(node));
  if (!hand.allFinite()) throw base::InputError("", "a hand needs a finite place");
  const Eigen::Vector3d place = simulation_.state().positions.col(node);
  const auto [found, isNew] = hands_.try_emplace(node, hand);
  // A hand that comes nearer asks for something else than what was refused.
  if (isNew || (hand - place).norm() < (found->second - place).norm()) pause_ = 0;
  found->second = hand;
}

void Dragging::letGo(int node, bool stay) {
  const auto found = hands_.find(node);
  if (found == hands_.end()) return;
  const auto held = heldNodes(simulation_.problem(), simulation_.state().time + simulation_.options().timeStep);
  if (stay || held[static_cast<std::size_t>(node)]) {
    found->second = simulation_.state().positions.col(node);
    simulation_.setPinTarget(node, found->second);
  } else {
    hands_.erase(found);
    simulation_.releasePinTarget(node);
  }
  refusals_ = pause_ = 0;
  obstacle_.clear();
}

bool Dragging::isPulled() const {
  return std::any_of(hands_.begin(), hands_.end(), [&](const auto& hand) {
    return (hand.second - simulation_.state().positions.col(hand.first)).norm() > arrived * reach_;
  });
}

void Dragging::aim(double fraction) {
  for (const auto& [node, hand] : hands_) {
    const Eigen::Vector3d place = simulation_.state().positions.col(node);
    const Eigen::Vector3d way = hand - place;
    const double length = way.norm();
    const bool arrives = length <= std::max(fraction, arrived) * reach_;
    simulation_.setPinTarget(node, arrives ? hand : place + fraction * reach_ / length * way);
  }
}

StepRecord Dragging::step(base::ExecutionContext& context) {
  if (!isPulled()) obstacle_.clear();
  if (pause_ > 0) --pause_;
  if (isPulled() && pause_ == 0) {
    aim(std::ldexp(1.0, -refusals_));
    StepRecord record = simulation_.step(context);
    if (record.done()) {
      refusals_ = std::max(0, refusals_ - 1);
      if (refusals_ == 0) obstacle_.clear();
      return record;
    }
    if (record.termination == base::TerminationType::cancelled) return record;
    obstacle_ = record.message;
    refusals_ = std::min(mostRefusals, refusals_ + 1);
    pause_ = 1 << refusals_;
  }
  aim(0);
  StepRecord record = simulation_.step(context);
  if (record.done() || !isPulled() || record.termination == base::TerminationType::cancelled) return record;
  // Taut between hands and pins there is no room to move, and what the sheet was about to do may be far from possible.
  const ClothState before = simulation_.state();
  simulation_.setState(before.time, before.positions, Eigen::Matrix3Xd::Zero(3, before.positions.cols()));
  aim(givingWay);
  StepRecord last = simulation_.step(context);
  if (!last.done()) simulation_.setState(before.time, before.positions, before.velocities);
  return last;
}

}  // namespace pliant::cloth
