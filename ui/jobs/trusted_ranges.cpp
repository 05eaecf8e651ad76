#include "ui/jobs/trusted_ranges.hpp"

#include <utility>

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"

namespace pliant::jobs {

namespace {

const QString trustTopic = QStringLiteral("trust");
const QString wayTopic = QStringLiteral("trust of a way");

/// How often a way may be gone; 0 if it is none, or its parameters leave no room for a difference.
double reachOf(const harmonic::PredictionError& error, const harmonic::Vector& way) {
  if (way.size() == 0 || way.isZero(0)) return 0;
  try {
    return error.trustedReach(way, TrustedRanges::share);
  } catch (const base::InputError&) {
    return 0;
  }
}

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
  runner_.abandonTopic(wayTopic);
  const bool had = !ranges_.empty() || reach_;
  ranges_.clear();
  reach_.reset();
  error_.reset();
  if (had) Q_EMIT changed();
  if (!sensitivity || !sensitivity->regular()) return;
  Job job;
  job.topic = trustTopic;
  job.work = [this, problem = shown->problem, motion = shown->motion, sensitivity](
                 base::ExecutionContext& context, const Publish&) -> Delivery {
    std::map<std::string, ParameterRange> ranges;
    const harmonic::HarmonicBalanceProblem own(*problem);
    const auto error = std::make_shared<const harmonic::PredictionError>(own, motion, *sensitivity);
    const auto& parameters = own.model().parameters;
    for (std::size_t i = 0; error->regular() && i < parameters.size(); ++i) {
      if (context.cancelRequested()) return {};
      try {
        ranges[parameters[i]->pointer()] = error->trustedRange(static_cast<int>(i), share);
      } catch (const base::InputError&) {
        continue;  // its bounds leave no room for a difference
      }
    }
    return [this, sensitivity, error, ranges = std::move(ranges)] {
      if (of_ != sensitivity) return;
      ranges_ = ranges;
      if (error->regular()) error_ = error;
      Q_EMIT changed();
      findReach();
    };
  };
  runner_.submit(std::move(job));
}

void TrustedRanges::setWays(harmonic::Vector towards, harmonic::Vector away) {
  const auto same = [](const harmonic::Vector& a, const harmonic::Vector& b) {
    return a.size() == b.size() && (a - b).isZero(0);
  };
  if (same(towards_, towards) && same(away_, away)) return;
  towards_ = std::move(towards);
  away_ = std::move(away);
  if (std::exchange(reach_, std::nullopt)) Q_EMIT changed();
  findReach();
}

void TrustedRanges::findReach() {
  runner_.abandonTopic(wayTopic);
  if (!error_ || towards_.size() == 0) return;
  Job job;
  job.topic = wayTopic;
  job.work = [this, error = error_, towards = towards_, away = away_](
                 base::ExecutionContext& context, const Publish&) -> Delivery {
    if (context.cancelRequested()) return {};
    const Reach reach{reachOf(*error, towards), reachOf(*error, away)};
    return [this, error, reach] {
      if (error_ != error) return;
      reach_ = reach;
      Q_EMIT changed();
    };
  };
  runner_.submit(std::move(job));
}

}  // namespace pliant::jobs
