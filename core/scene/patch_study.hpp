#pragma once

#include "core/interlock/bending_limit.hpp"
#include "core/scene/bending_result.hpp"
#include "core/scene/interlock_study.hpp"

namespace pliant::scene {

/// What the keys "centre" and either "radius" or "size" of a study's entry say. Throws base::InputError (location
/// empty) if neither or both of the latter are there.
interlock::PatchOutline patchOutline(const Json& options);

/// Elements of a patch that are no farther than `width` [m] from the first ones in a direction [rad].
std::vector<int> clampedElements(const interlock::UnitCell& patch, double direction, double width);

/// What studies of finite patches have in common.
class PatchStudy : public InterlockStudy {
 public:
  PatchStudy(const Scene& scene, const Json& options);

 protected:
  std::shared_ptr<const interlock::UnitCell> cut(const interlock::PatchOutline& outline) const;
  /// The one that the study's own outline cuts out.
  std::shared_ptr<const interlock::UnitCell> cut() const;

  interlock::EquilibriumOptions equilibriumOptions() const;
  interlock::BendingOptions bendingOptions() const;

 private:
  std::string place_;  ///< of the study in its scene
};

}  // namespace pliant::scene
