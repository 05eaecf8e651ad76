#pragma once

#include "core/interlock/patch_equilibrium.hpp"
#include "core/scene/macro_builder.hpp"
#include "core/scene/macro_result.hpp"

namespace pliant::scene {

/// The elements that a "macro_equilibrium" computes beside its sheet: under the same loads, as they come.
class NativePatch {
 public:
  /// `options` are the study's, `place` is where it stands. Throws base::InputError for a study without such a patch,
  /// and as interlock::cutPatch.
  NativePatch(const interlock::UnitCell& cell, const Json& options, const std::string& place,
              const interlock::EquilibriumOptions& equilibrium);

  /// Rests under this part of all loads, from where it rested last; then `comparison` is with the sheet as it is there.
  void load(double part, const geometry::SurfaceMesh& mesh, const interlock::Vector& positions,
            const base::ExecutionContext& context);
  const NativeComparison& comparison() const { return comparison_; }

 private:
  NativeComparison comparison_;
  Eigen::Matrix3Xd rest_;  ///< origins
  std::vector<int> loaded_;
  interlock::PatchLoads loads_;
  std::unique_ptr<const interlock::PatchSolver> solver_;
};

/// The patch of such a study. Throws base::InputError.
interlock::UnitCell nativePatchOf(const interlock::UnitCell& cell, const Json& options);

}  // namespace pliant::scene
