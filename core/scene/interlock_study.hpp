#pragma once

#include "core/base/stopwatch.hpp"
#include "core/interlock/deformation_test.hpp"
#include "core/scene/interlock_result.hpp"

namespace pliant::scene {

/// What studies of interlocking materials have in common. A cell has no part in the scene's model.
class InterlockStudy : public Study {
 public:
  /// Throws base::InputError if the cell is faulty.
  InterlockStudy(const Scene& scene, const Json& options);

  std::string name() const override { return options_["name"]; }
  std::string type() const override { return options_["type"]; }

 protected:
  interlock::EquilibriumOptions equilibriumOptions() const;
  /// Of the key "lateral".
  interlock::Lateral lateral() const;
  /// What kept limits hold for.
  std::string key() const;
  void finish(InterlockResult& result, base::TerminationType termination, const std::string& message,
              const base::Stopwatch& watch) const;

  std::shared_ptr<const interlock::UnitCell> cell_;
  Json options_;
  std::filesystem::path directory_;
  Provenance provenance_;
};

}  // namespace pliant::scene
