#pragma once

#include <QString>

#include "core/scene/scene.hpp"

namespace pliant::shell {

/// An edit that gives a scene a target path.
struct TargetEntry {
  std::string pointer;
  scene::Json value;
  QString note;  ///< what else it changes; empty: nothing
};

/// Puts `path` ({"probe": ..., "spline": ...}) at `pointer`; where that is empty, into an objective of its own. The
/// first design study gets it, in the place of amplitudes that it was to make large, which would outweigh it; without
/// one there will be one at `omega` [rad/s; 0: unknown, then that of the first study that has a frequency, else 1 Hz].
TargetEntry targetEntry(const scene::Scene& scene, const std::string& pointer, const scene::Json& path, double omega);

}  // namespace pliant::shell
