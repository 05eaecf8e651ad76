#pragma once

#include <filesystem>
#include <fstream>

#include "core/interlock/strain_space_boundary.hpp"

namespace pliant::interlock {

/// States of a boundary that are known: a computation that was cancelled goes on where it was.
class KnownStates : public BoundaryMemory {
 public:
  bool recall(const std::string& name, BoundaryState& state) override;
  void keep(const std::string& name, const BoundaryState& state) override;

  /// Adds what a BoundaryFile holds. False if it was begun with another `key`, or is not there. Throws base::InputError
  /// with the file as location if it is no such file.
  bool read(const std::filesystem::path& file, const std::string& key);
  int count() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(states_.size());
  }

 protected:
  std::map<std::string, BoundaryState> states_;
  mutable std::mutex mutex_;
};

/// What has been computed of a boundary, in a text file that grows by a line a state and so survives being killed; a
/// line cut short is left out when it is read. Numbers keep every bit.
class BoundaryFile final : public KnownStates {
 public:
  /// Goes on with the file if it was begun with the same `key` (one line that tells cell and options), else begins
  /// anew. Throws base::InputError with the file as location if it cannot be written, or is there and is no such file.
  BoundaryFile(const std::filesystem::path& file, const std::string& key);

  void keep(const std::string& name, const BoundaryState& state) override;
  /// States that were there already.
  int recalledCount() const { return recalled_; }

 private:
  std::ofstream out_;
  int recalled_ = 0;
};

}  // namespace pliant::interlock
