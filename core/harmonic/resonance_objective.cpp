#include "core/harmonic/resonance_objective.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include "core/harmonic/curve_sensitivity.hpp"
#include "core/harmonic/frequency_response.hpp"
#include "core/harmonic/mode_sensitivity.hpp"
#include "core/mechanics/drive_frequency.hpp"

namespace pliant::harmonic {

namespace {

ObjectiveValue impossibleDesign(const HarmonicBalanceProblem& problem) {
  const Model& model = problem.model();
  return {std::numeric_limits<double>::infinity(), Matrix::Zero(problem.basis().size(), model.coordinateCount()),
          Vector::Zero(static_cast<Eigen::Index>(model.parameters.size()))};
}

std::vector<int> allParameters(const Model& model) {
  std::vector<int> all(model.parameters.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

ObjectiveValue placed(const HarmonicBalanceProblem& problem, double omega, const Vector& derivative, double wanted) {
  ObjectiveValue result = impossibleDesign(problem);
  const double offset = (omega - wanted) / wanted;
  result.value = offset * offset;
  result.byParameters = 2 * offset / wanted * derivative;
  // A peak is where it is, at whatever frequency the design's own motion is.
  const auto& parameters = problem.model().parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (mechanics::isDriveFrequency(*parameters[i])) result.byParameters[static_cast<Eigen::Index>(i)] = 0;
  return result;
}

class PeakPlacement final : public DesignObjective {
 public:
  explicit PeakPlacement(const ResonancePlacement& goal) : goal_(goal) {}

  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector&) const override {
    const std::vector<int> parameters = allParameters(problem.model());
    std::optional<PeakSensitivity> peak;
    if (last_.z.size() == problem.size()) peak = followPeak(problem, last_, parameters);
    if (!peak && findOnCurve(problem)) peak = peakSensitivity(problem, last_, parameters);
    if (!peak) return impossibleDesign(problem);
    last_.z = peak->z;
    last_.omega = peak->omega;
    return placed(problem, peak->omega, peak->omegaDerivative, goal_.frequency);
  }

 private:
  /// The peak nearest to where it is to lie, in `last_`; false if there is none.
  bool findOnCurve(const HarmonicBalanceProblem& problem) const {
    HarmonicBalanceProblem traced(problem);
    FrequencyResponseOptions options;
    options.from = goal_.from;
    options.to = goal_.to;
    options.stability = false;
    options.newton = goal_.motion;
    base::ExecutionContext context;
    double nearest = std::numeric_limits<double>::infinity();
    traceFrequencyResponse(traced, options, context, [&](const ResponsePoint& point) {
      const double distance = std::abs(point.omega - goal_.frequency);
      if (point.kind != PointKind::peak || point.probe != goal_.probe || distance >= nearest) return;
      nearest = distance;
      last_ = point;
    });
    return std::isfinite(nearest);
  }

  ResonancePlacement goal_;
  mutable ResponsePoint last_;  ///< the peak of the design before
};

/// The modes up to above a frequency, and at least one; none if there is no stable equilibrium.
LinearModes modesUpTo(const HarmonicBalanceProblem& problem, double omega) {
  base::ExecutionContext context;
  for (LinearModesOptions options;; options.count *= 2) {
    LinearModes modes = computeLinearModes(problem, options, context);
    if (!modes.report.converged() || static_cast<int>(modes.modes.size()) < options.count ||
        modes.modes.back().omega > omega)
      return modes;
  }
}

class ModePlacement final : public DesignObjective {
 public:
  explicit ModePlacement(LinearResonancePlacement goal) : goal_(goal) {}

  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector&) const override {
    const LinearModes modes = computed(problem);
    const int count = static_cast<int>(modes.modes.size());
    int chosen = goal_.mode.value_or(0);
    for (int i = 0; !goal_.mode && i < count; ++i)
      if (distance(modes, i) < distance(modes, chosen)) chosen = i;
    if (!modes.report.converged() || chosen >= count) return impossibleDesign(problem);
    return placed(problem, modes.modes[static_cast<std::size_t>(chosen)].omega,
                  naturalFrequencyDerivatives(problem, modes, {chosen}, allParameters(problem.model())).row(0),
                  goal_.frequency);
  }

 private:
  LinearModes computed(const HarmonicBalanceProblem& problem) const {
    if (!goal_.mode) return modesUpTo(problem, 2 * goal_.frequency);  // one above is nearer than 0
    LinearModesOptions options;
    options.count = *goal_.mode + 1;
    base::ExecutionContext context;
    return computeLinearModes(problem, options, context);
  }
  double distance(const LinearModes& modes, int i) const {
    return std::abs(modes.modes[static_cast<std::size_t>(i)].omega - goal_.frequency);
  }

  LinearResonancePlacement goal_;
};

class ModeAvoidance final : public DesignObjective {
 public:
  explicit ModeAvoidance(ResonanceAvoidance goal) : goal_(goal) {}

  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector&) const override {
    const LinearModes modes = modesUpTo(problem, goal_.frequency + goal_.halfWidth);
    if (!modes.report.converged()) return impossibleDesign(problem);
    ObjectiveValue result = impossibleDesign(problem);
    result.value = 0;
    std::vector<int> inside;
    std::vector<double> slopes;  // of the penalty by ω
    for (std::size_t i = 0; i < modes.modes.size(); ++i) {
      const double place = (modes.modes[i].omega - goal_.frequency) / goal_.halfWidth;
      const double depth = 1 - place * place;
      if (depth <= 0) continue;
      result.value += depth * depth;
      inside.push_back(static_cast<int>(i));
      slopes.push_back(-4 * depth * place / goal_.halfWidth);
    }
    const Matrix derivatives = naturalFrequencyDerivatives(problem, modes, inside, allParameters(problem.model()));
    for (std::size_t i = 0; i < inside.size(); ++i)
      result.byParameters += slopes[i] * derivatives.row(static_cast<Eigen::Index>(i)).transpose();
    return result;
  }

 private:
  ResonanceAvoidance goal_;
};

}  // namespace

std::shared_ptr<const DesignObjective> makeResonancePlacement(const ResonancePlacement& goal) {
  return std::make_shared<PeakPlacement>(goal);
}

std::shared_ptr<const DesignObjective> makeLinearResonancePlacement(LinearResonancePlacement goal) {
  return std::make_shared<ModePlacement>(goal);
}

std::shared_ptr<const DesignObjective> makeResonanceAvoidance(ResonanceAvoidance goal) {
  return std::make_shared<ModeAvoidance>(goal);
}

std::vector<ObjectiveKind> resonanceObjectiveKinds() {
  using Problem = HarmonicBalanceProblem;
  PeriodicMotionOptions exact;
  exact.tolerance = exact.stepTolerance = 1e-12;
  return {{"resonance placement",
           [exact](const Problem&, std::mt19937&) {
             return makeResonancePlacement({3, 0, 1, 6, exact});
           }},
          {"linear resonance placement",
           [](const Problem&, std::mt19937&) {
             return makeLinearResonancePlacement({5, {}});
           }},
          {"linear resonance placement, second mode",
           [](const Problem&, std::mt19937&) {
             return makeLinearResonancePlacement({2, 1});
           }},
          {"resonance avoidance", [](const Problem&, std::mt19937&) {
             return makeResonanceAvoidance({4, 3});
           }}};
}

}  // namespace pliant::harmonic
