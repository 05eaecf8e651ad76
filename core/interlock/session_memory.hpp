#pragma once

#include "core/interlock/strain_space_boundary.hpp"

namespace pliant::interlock {

/// What has been computed of a boundary, for as long as this lives: a computation that was cancelled goes on where it
/// was, with the same result to the last bit.
class SessionMemory final : public BoundaryMemory {
 public:
  bool recall(const std::string& name, BoundaryState& state) override {
    const std::lock_guard lock(mutex_);
    const auto found = states_.find(name);
    if (found == states_.end()) return false;
    state = found->second;
    return true;
  }
  void keep(const std::string& name, const BoundaryState& state) override {
    const std::lock_guard lock(mutex_);
    states_[name] = state;
  }
  int count() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(states_.size());
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, BoundaryState> states_;
};

}  // namespace pliant::interlock
