#pragma once

#include "core/scene/interlock_study.hpp"
#include "core/scene/macro_builder.hpp"
#include "core/scene/macro_result.hpp"

namespace pliant::scene {

/// What studies of sheets have in common.
class MacroStudy : public InterlockStudy {
 public:
  MacroStudy(const Scene& scene, const Json& options);

 protected:
  /// The result of a study that begins, with its sheet; `sheet` is the same.
  std::shared_ptr<MacroResult> begin(interlock::MacroSheet& sheet, base::ExecutionContext& context) const;
  /// Of a study that was cancelled before anything moved.
  static void judgeNothing(MacroResult& result);
  /// How far the making of the sheet takes the progress.
  double begun() const { return options_.contains("stretch_limits") ? 0.05 : 0.6; }

  Scene scene_;
  std::string place_;  ///< for errors
  MacroBuilder builder_;
};

}  // namespace pliant::scene
