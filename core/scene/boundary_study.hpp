#pragma once

#include <functional>
#include <optional>

#include "core/scene/boundary_shards.hpp"
#include "core/scene/resumable_study.hpp"
#include "core/scene/sharded_study.hpp"

namespace pliant::scene {

/// A study of all limits of something, which can be shared among processes and go on after it was cancelled or killed.
/// `Base`: InterlockStudy or PatchStudy; `Result`: an InterlockResult with a LimitSurface.
template <class Base, class SurfaceResult>
class BoundaryStudy : public Base, public ShardedStudy, public ResumableStudy {
 public:
  using Base::Base;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    std::optional<interlock::BoundaryFile> file;
    if (this->options_.contains("checkpoint"))
      file.emplace(this->directory_ / this->options_["checkpoint"].template get<std::string>(), this->key());
    const auto session = memory_ ? memory_ : std::make_shared<interlock::KnownStates>();
    auto result = file ? resultOf(*file, file->recalledCount(), nullptr, context, observe)
                       : resultOf(*session, session->count(), session, context, observe);
    if (observe) observe(result);
    return result;
  }

  void goOnFrom(const Result& before) override {
    const auto* result = dynamic_cast<const SurfaceResult*>(&before);
    if (!result || !result->memory || result->termination != base::TerminationType::cancelled) return;
    const Provenance &other = result->provenance, &own = this->provenance_;
    if (other.version == own.version && other.sceneHash == own.sceneHash && other.options == this->options_)
      memory_ = result->memory;
  }

  const ShardedStudy* sharded() const override { return this; }
  base::TerminationType runShard(const base::Shard& shard, const std::filesystem::path& file,
                                 base::ExecutionContext& context) const override {
    base::TerminationType termination = base::TerminationType::failed;
    SurfaceResult ignored;
    withSubject(ignored, [&](const interlock::BoundarySubject& subject) {
      termination = runBoundaryShard(subject, boundaryOptions(), this->key(), shard, file, context);
    });
    return termination;
  }
  std::shared_ptr<const Result> merge(const std::vector<std::filesystem::path>& files,
                                      base::ExecutionContext& context) const override {
    interlock::KnownStates known;
    SurfaceResult ignored;
    withSubject(ignored, [&](const interlock::BoundarySubject& subject) {
      readBoundaryShards(subject, boundaryOptions(), this->key(), files, known);
    });
    return resultOf(known, known.count(), nullptr, context, {});
  }

 protected:
  using Use = std::function<void(const interlock::BoundarySubject&)>;
  /// Makes what is deformed, for as long as `use` lasts, and tells the result what it is.
  virtual void withSubject(SurfaceResult& result, const Use& use) const = 0;
  virtual interlock::BoundaryOptions boundaryOptions() const = 0;

 private:
  /// `session`: for a later run to go on from, if this one is cancelled.
  std::shared_ptr<const SurfaceResult> resultOf(interlock::BoundaryMemory& memory, int recalled,
                                                const std::shared_ptr<interlock::KnownStates>& session,
                                                base::ExecutionContext& context, const ResultObserver& observe) const {
    const base::Stopwatch watch;
    SurfaceResult described;
    std::shared_ptr<const SurfaceResult> found;
    withSubject(described, [&](const interlock::BoundarySubject& subject) {
      const auto resultWith = [&](interlock::StrainSpaceBoundary boundary, base::TerminationType termination) {
        auto result = std::make_shared<SurfaceResult>(described);
        result->recalled = recalled;
        if (termination == base::TerminationType::cancelled) result->memory = session;
        const std::string message = boundary.message;
        result->boundary = std::move(boundary);
        this->finish(*result, termination, message, watch);
        return result;
      };
      interlock::BoundaryObserver observeBoundary;
      if (observe)
        observeBoundary = [&](const interlock::StrainSpaceBoundary& soFar) {
          observe(resultWith(soFar, base::TerminationType::cancelled));
        };
      auto boundary = interlock::computeBoundary(subject, boundaryOptions(), context, &memory, observeBoundary);
      const base::TerminationType termination = boundary.termination;
      found = resultWith(std::move(boundary), termination);
    });
    return found;
  }

  std::shared_ptr<interlock::KnownStates> memory_;  ///< of a cancelled run; null: none
};

}  // namespace pliant::scene
