#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// A study that can go on from what a run before it had found when it was cancelled, to the same result.
class ResumableStudy {
 public:
  virtual ~ResumableStudy() = default;
  /// Before run(). Without effect unless `before` is a cancelled result of the same study, scene and version.
  virtual void goOnFrom(const Result& before) = 0;
};

}  // namespace pliant::scene
