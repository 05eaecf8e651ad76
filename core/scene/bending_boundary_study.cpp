#include <optional>

#include "core/interlock/bending_boundary.hpp"
#include "core/scene/bending_studies.hpp"
#include "core/scene/boundary_shards.hpp"
#include "core/scene/patch_study.hpp"
#include "core/scene/resumable_study.hpp"
#include "core/scene/sharded_study.hpp"

namespace pliant::scene {

using base::TerminationType;

namespace {

class BendingBoundaryStudy final : public PatchStudy, public ShardedStudy, public ResumableStudy {
 public:
  using PatchStudy::PatchStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    std::optional<interlock::BoundaryFile> file;
    if (options_.contains("checkpoint")) file.emplace(directory_ / options_["checkpoint"].get<std::string>(), key());
    const auto session = memory_ ? memory_ : std::make_shared<interlock::KnownStates>();
    auto result = file ? resultOf(*file, file->recalledCount(), nullptr, context, observe)
                       : resultOf(*session, session->count(), session, context, observe);
    if (observe) observe(result);
    return result;
  }

  void goOnFrom(const Result& before) override {
    const auto* result = dynamic_cast<const BendingBoundaryResult*>(&before);
    if (!result || !result->memory || result->termination != TerminationType::cancelled) return;
    const Provenance& other = result->provenance;
    if (other.version == provenance_.version && other.sceneHash == provenance_.sceneHash && other.options == options_)
      memory_ = result->memory;
  }

  const ShardedStudy* sharded() const override { return this; }
  TerminationType runShard(const base::Shard& shard, const std::filesystem::path& file,
                           base::ExecutionContext& context) const override {
    const auto patch = cut();
    const interlock::PatchSolver solver(*patch, equilibriumOptions());
    return runBoundaryShard(
        interlock::BentPatch(solver, bendingOptions()), boundaryOptions(), key(), shard, file, context);
  }
  std::shared_ptr<const Result> merge(const std::vector<std::filesystem::path>& files,
                                      base::ExecutionContext& context) const override {
    const auto patch = cut();
    const interlock::PatchSolver solver(*patch, equilibriumOptions());
    interlock::KnownStates known;
    readBoundaryShards(interlock::BentPatch(solver, bendingOptions()), boundaryOptions(), key(), files, known);
    return resultOf(known, known.count(), nullptr, context, {});
  }

 private:
  interlock::BoundaryOptions boundaryOptions() const {
    interlock::BoundaryOptions options;
    options.subdivisions = options_["subdivisions"];
    options.perturbation = options_["perturbation"];
    options.seed = options_["seed"];
    options.testStarShape = options_["test_star_shape"];
    return options;
  }

  /// `session`: for a later run to go on from, if this one is cancelled.
  std::shared_ptr<const BendingBoundaryResult> resultOf(interlock::BoundaryMemory& memory, int recalled,
                                                        const std::shared_ptr<interlock::KnownStates>& session,
                                                        base::ExecutionContext& context,
                                                        const ResultObserver& observe) const {
    const base::Stopwatch watch;
    const auto patch = cut();
    const auto resultWith = [&](interlock::StrainSpaceBoundary boundary, TerminationType termination) {
      auto result = std::make_shared<BendingBoundaryResult>();
      result->patch = patch;
      result->recalled = recalled;
      if (termination == TerminationType::cancelled) result->memory = session;
      const std::string message = boundary.message;
      result->boundary = std::move(boundary);
      finish(*result, termination, message, watch);
      return result;
    };
    interlock::BoundaryObserver observeBoundary;
    if (observe)
      observeBoundary = [&](const interlock::StrainSpaceBoundary& soFar) {
        observe(resultWith(soFar, TerminationType::cancelled));
      };
    const interlock::PatchSolver solver(*patch, equilibriumOptions());
    auto boundary = interlock::computeBoundary(
        interlock::BentPatch(solver, bendingOptions()), boundaryOptions(), context, &memory, observeBoundary);
    const TerminationType termination = boundary.termination;
    return resultWith(std::move(boundary), termination);
  }

  std::shared_ptr<interlock::KnownStates> memory_;  ///< of a cancelled run; null: none
};

}  // namespace

std::unique_ptr<Study> makeBendingBoundaryStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                                const Json& options) {
  return std::make_unique<BendingBoundaryStudy>(scene, options);
}

}  // namespace pliant::scene
