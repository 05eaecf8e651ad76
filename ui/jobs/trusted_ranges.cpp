#include "ui/jobs/trusted_ranges.hpp"

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"

namespace pliant::jobs {

namespace {

const QString trustTopic = QStringLiteral("trust");

}  // namespace

using harmonic::ParameterRange;

TrustedRanges::TrustedRanges(MotionSession& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_, &MotionSession::shownChanged, this, &TrustedRanges::follow);
  connect(&session_, &MotionSession::effectsChanged, this, &TrustedRanges::follow);
  follow();
}

std::optional<ParameterRange> TrustedRanges::range(const std::string& pointer) const {
  const auto found = ranges_.find(pointer);
  return found == ranges_.end() ? std::nullopt : std::optional(found->second);
}

void TrustedRanges::follow() {
  const auto& shown = session_.shown();
  const auto sensitivity = shown ? shown->sensitivity : nullptr;
  if (sensitivity == of_) return;
  of_ = sensitivity;
  runner_.abandonTopic(trustTopic);
  const bool had = !ranges_.empty();
  ranges_.clear();
  if (had) Q_EMIT changed();
  if (!sensitivity || !sensitivity->regular()) return;
  Job job;
  job.topic = trustTopic;
  job.work = [this, problem = shown->problem, motion = shown->motion, sensitivity](
                 base::ExecutionContext& context, const Publish&) -> Delivery {
    std::map<std::string, ParameterRange> ranges;
    const harmonic::HarmonicBalanceProblem own(*problem);
    const harmonic::PredictionError error(own, motion, *sensitivity);
    const auto& parameters = own.model().parameters;
    for (std::size_t i = 0; error.regular() && i < parameters.size(); ++i) {
      if (context.cancelRequested()) return {};
      try {
        ranges[parameters[i]->pointer()] = error.trustedRange(static_cast<int>(i), share);
      } catch (const base::InputError&) {
        continue;  // its bounds leave no room for a difference
      }
    }
    return [this, sensitivity, ranges = std::move(ranges)] {
      if (of_ != sensitivity) return;
      ranges_ = ranges;
      Q_EMIT changed();
    };
  };
  runner_.submit(std::move(job));
}

}  // namespace pliant::jobs
