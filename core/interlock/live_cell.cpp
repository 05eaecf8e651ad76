#include "core/interlock/live_cell.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace pliant::interlock {

using base::TerminationType;
using Eigen::Vector3d;

namespace {

constexpr double strongestPull = 0.5;  ///< of the lattice's length: where the hand's spring is stretched to its most
constexpr double holdBack = 1e-3;      ///< springs that keep what nobody pulls, relative to the hand's
constexpr double reachedWithin = 1e-3, movedLess = 1e-4;  ///< of the lattice's length
constexpr double pushing = 0.01;                          ///< of the strongest contact: weaker ones hold nothing

/// To see is less than to measure: gaps of a thousandth of the wire.
EquilibriumOptions liveOptions() {
  EquilibriumOptions options;
  options.finalGap = 1e-3;
  options.firstGap = 0.03;
  return options;
}

/// Contacts of one pair of elements nearer than `apart` count as one.
std::vector<LiveContact> mergedContacts(const std::vector<CellContactForce>& forces, double apart) {
  std::vector<LiveContact> merged;
  for (const CellContactForce& force : forces) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const LiveContact& other) {
      return other.a == force.pair.a && other.b == force.pair.b && other.shift == force.pair.shift &&
             (other.place - force.place).norm() < apart;
    });
    if (same == merged.end()) {
      merged.push_back({force.pair.a, force.pair.b, force.pair.shift, force.place, force.gap, force.force});
      continue;
    }
    const double sum = same->force + force.force;
    if (sum > 0) same->place += force.force / sum * (force.place - same->place);
    same->force = sum;
    same->gap = std::min(same->gap, force.gap);
  }
  std::sort(merged.begin(), merged.end(), [](const auto& x, const auto& y) { return x.force > y.force; });
  while (!merged.empty() && merged.back().force < pushing * merged.front().force) merged.pop_back();
  return merged;
}

}  // namespace

LiveCell::LiveCell(const UnitCell& cell)
    : solver_(cell, liveOptions()), length_(std::sqrt(std::abs(cell.lattice.determinant()))), state_(restState(cell)) {}

ElementPull LiveCell::pullOf(const Held& held) const {
  ElementPull pull;
  pull.element = held.grip.element;
  pull.arm = held.grip.arm;
  pull.shift = held.grip.shift;
  pull.target = held.hand;
  pull.spring = 1 / (length_ * length_);
  pull.strongest = strongestPull / length_;
  return pull;
}

Vector3d LiveCell::placeOf(const CellGrip& grip) const {
  return interlock::placeOf(cell(), state_, pullOf({grip, Vector3d::Zero()}));
}

void LiveCell::pull(const CellGrip& grip, const Vector3d& hand) {
  const int count = static_cast<int>(cell().elements.size());
  if (grip.element < 0 || grip.element >= count)
    throw base::InputError(
        "", "there is no element " + std::to_string(grip.element) + " in a cell of " + std::to_string(count));
  if (!hand.allFinite() || !grip.arm.allFinite() || !grip.shift.allFinite())
    throw base::InputError("", "a hand must be at a place, but its coordinates are not finite");
  held_ = Held{grip, hand};
}

void LiveCell::reset() {
  state_ = restState(cell());
  held_.reset();
}

LiveStep LiveCell::advance(const base::ExecutionContext* context) {
  LiveStep step;
  const double radius = cell().smallestRadius();
  if (!held_) {
    step.smallestGap = solver_.contact().smallestGap(state_, 2 * radius);
    return step;
  }
  StrainDrive drive;
  drive.pulls.push_back(pullOf(*held_));
  drive.spring = holdBack;
  drive.target = state_.strain;
  for (int i = 1; i < static_cast<int>(cell().elements.size()); ++i) {
    ElementPull stay;
    stay.element = i;
    stay.spring = holdBack / (length_ * length_);
    stay.target = state_.positions.col(i);
    drive.pulls.push_back(stay);
  }
  const Vector3d before = placeOf(held_->grip);
  if ((before - held_->hand).norm() > 1e-9 * length_) {
    const CellEquilibrium rest = solver_.solve(state_, drive, context);
    step.termination = rest.termination;
    step.message = rest.message;
    state_ = rest.state;
    step.contacts = mergedContacts(rest.contacts, radius);
  }
  const Vector3d after = placeOf(held_->grip);
  step.smallestGap = solver_.contact().smallestGap(state_, 2 * radius);
  step.missing = (after - held_->hand).norm();
  const bool reached = step.missing < reachedWithin * length_;
  step.settled =
      step.termination != TerminationType::cancelled && (reached || (after - before).norm() < movedLess * length_);
  step.locked = !reached && step.settled && !step.contacts.empty();
  return step;
}

}  // namespace pliant::interlock
