#pragma once

#include <functional>

#include "core/harmonic/branch_switching.hpp"
#include "core/harmonic/frequency_response.hpp"
#include "core/harmonic/response_branch.hpp"
#include "core/harmonic/stability_tracker.hpp"

namespace pliant::harmonic {

/// Traces a response curve and those that branch off it: what traceFrequencyResponse does.
class ResponseTracer {
 public:
  using PointCallback = std::function<void(const ResponsePoint&)>;

  ResponseTracer(const HarmonicBalanceProblem& problem, const FrequencyResponseOptions& options,
                 base::ExecutionContext& context, const PointCallback& onPoint);

  FrequencyResponse run(const Vector& start);

 private:
  /// One curve while it is traced.
  struct Curve {
    std::shared_ptr<const HarmonicBalanceProblem> problem;
    int index = 0;
    int depth = 0;
    const Crossing* origin = nullptr;     ///< null for the first curve
    const ResponsePoint* twin = nullptr;  ///< the first point beyond the crossing in the opposite direction
    std::size_t points = 0;
  };

  base::SolverReport trace(Curve& curve, const solvers::ContinuationOptions& continuation, const Vector& z,
                           double omega);
  void follow(std::size_t crossing);
  bool receive(Curve& curve, const solvers::BranchPoint& at, StabilityTracker& tracker);
  void emit(Curve& curve, TrackedPoint&& tracked);
  solvers::ContinuationOptions continuationOptions() const;
  Crossing* crossingAt(const Curve& curve, const solvers::BranchPoint& at);

  std::shared_ptr<const HarmonicBalanceProblem> problem_;
  const FrequencyResponseOptions& options_;
  base::ExecutionContext& context_;
  const PointCallback& onPoint_;
  double stateScale_ = 1;
  int curves_ = 0;
  std::vector<Crossing> crossings_;
  FrequencyResponse response_;
};

}  // namespace pliant::harmonic
