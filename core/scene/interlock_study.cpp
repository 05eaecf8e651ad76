#include "core/scene/interlock_study.hpp"

#include "core/scene/interlock_builder.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

InterlockStudy::InterlockStudy(const Scene& scene, const Json& options)
    : cell_(std::make_shared<const interlock::UnitCell>(buildCell(scene, options["cell"]))),
      options_(options),
      directory_(scene.directory()),
      provenance_(provenanceOf(scene, options)) {}

interlock::EquilibriumOptions InterlockStudy::equilibriumOptions() const {
  interlock::EquilibriumOptions options;
  options.finalGap = options_["final_gap"];
  options.friction = options_.value("friction", 0.0);
  return options;
}

interlock::Lateral InterlockStudy::lateral() const {
  const std::string name = options_["lateral"];
  if (name == "principal") return interlock::Lateral::principal;
  if (name == "biaxial") return interlock::Lateral::biaxial;
  return name == "held" ? interlock::Lateral::held : interlock::Lateral::free;
}

std::string InterlockStudy::key() const {
  return provenance_.version + " " + provenance_.sceneHash + " " + options_.dump();
}

void InterlockStudy::finish(InterlockResult& result, base::TerminationType termination, const std::string& message,
                            const base::Stopwatch& watch) const {
  if (!result.cell) result.cell = cell_;
  result.provenance = provenance_;
  result.termination = termination;
  result.message = message;
  result.seconds = watch.seconds();
}

}  // namespace pliant::scene
