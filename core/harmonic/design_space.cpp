#include "core/harmonic/design_space.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/base/stopwatch.hpp"
#include "core/harmonic/design_branch.hpp"
#include "core/math/low_discrepancy.hpp"
#include "core/math/parallel.hpp"
#include "core/mechanics/drive_frequency.hpp"

namespace pliant::harmonic {

namespace {

constexpr int designsPerBatch = 8;

class SpaceSampler {
 public:
  SpaceSampler(const HarmonicBalanceProblem& problem, const DesignSpaceOptions& options,
               base::ExecutionContext& context)
      : problem_(problem), context_(context), points_(static_cast<int>(options.parameters.size()), options.seed) {
    branchOptions_.omega = options.omega;
    branchOptions_.parameters = options.parameters;
    branchOptions_.motion = options.motion;
    for (const int index : options.parameters)
      parameters_.push_back(problem.model().parameters.at(static_cast<std::size_t>(index)));
  }

  /// Design `index` of the space, from the nearest of those that are known. Does not change anything.
  SampledDesign solve(int index, const std::vector<SampledDesign>& known) const {
    const DesignBranch bounds(problem_, branchOptions_, context_);
    SampledDesign design;
    design.variables = index == 0 ? bounds.firstVariables() : points_[index - 1];
    design.values = bounds.valuesOf(design.variables);
    design.from = nearest(design.variables, known);
    if (design.from >= 0 && follow(known[static_cast<std::size_t>(design.from)], design)) return design;
    design.from = -1;
    auto model = std::make_shared<Model>(mechanics::withParameterValues(problem_.model(), parameters_, design.values));
    HarmonicBalanceProblem anew(std::move(model), problem_.basis());
    const PeriodicMotion motion = solvePeriodicMotion(anew, omegaOf(anew), branchOptions_.motion, context_);
    if (motion.report.converged()) take(anew, motion.z, MotionOrigin::anew, design);
    return design;
  }

 private:
  double omegaOf(const HarmonicBalanceProblem& problem) const {
    return mechanics::driveFrequency(problem.model()).value_or(branchOptions_.omega);
  }

  static int nearest(const Vector& variables, const std::vector<SampledDesign>& known) {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (known[i].origin == MotionOrigin::none) continue;
      const double distance = (known[i].variables - variables).squaredNorm();
      if (distance < least) {
        least = distance;
        best = static_cast<int>(i);
      }
    }
    return best;
  }

  bool follow(const SampledDesign& from, SampledDesign& design) const {
    DesignBranch branch(HarmonicBalanceProblem(from.model, problem_.basis()), branchOptions_, context_);
    DesignPoint point = branch.beginAt(from.z);
    if (!point.motion.report.converged() || !branch.follow(point, design.variables)) return false;
    take(*point.problem, point.motion.z, MotionOrigin::followed, design);
    return true;
  }

  void take(const HarmonicBalanceProblem& problem, const Vector& z, MotionOrigin origin, SampledDesign& design) const {
    design.origin = origin;
    design.model = problem.sharedModel();
    design.z = z;
    design.residual = problem.residual(z, omegaOf(problem)).norm() / problem.forceScale(omegaOf(problem));
    for (const mechanics::Probe& probe : design.model->probes)
      design.amplitudes.push_back(amplitude(problem, z, probe.node));
  }

  const HarmonicBalanceProblem& problem_;
  base::ExecutionContext& context_;
  math::EvenPoints points_;
  InverseDesignOptions branchOptions_;
  std::vector<std::shared_ptr<const mechanics::DesignParameter>> parameters_;
};

}  // namespace

DesignSpace sampleDesignSpace(const HarmonicBalanceProblem& problem, const DesignSpaceOptions& options,
                              base::ExecutionContext& context, const std::function<void(const DesignSpace&)>& onBatch) {
  const base::Stopwatch watch;
  DesignSpace space;
  const SpaceSampler sampler(problem, options, context);
  const int count = options.count + 1;
  base::SolverReport& report = space.report;
  report.termination = base::TerminationType::converged;
  while (static_cast<int>(space.designs.size()) < count) {
    const auto done = static_cast<int>(space.designs.size());
    // The first alone, which all others can be followed from.
    const int batch = done == 0 ? 1 : std::min(designsPerBatch, count - done);
    context.setRange(options.progress * done / count, options.progress * (done + batch) / count);
    std::vector<SampledDesign> solved(static_cast<std::size_t>(batch));
    math::parallelFor(batch, [&](int i) {
      if (!context.cancelRequested()) solved[static_cast<std::size_t>(i)] = sampler.solve(done + i, space.designs);
    });
    if (context.cancelRequested()) {
      report.termination = base::TerminationType::cancelled;
      report.message = "The sampling was cancelled.";
      break;
    }
    std::move(solved.begin(), solved.end(), std::back_inserter(space.designs));
    context.reportProgress(1);
    if (onBatch) onBatch(space);
  }
  if (report.converged() && std::all_of(space.designs.begin(), space.designs.end(), [](const SampledDesign& design) {
        return design.origin == MotionOrigin::none;
      })) {
    report.termination = base::TerminationType::failed;
    report.message = "No design has a motion that could be found.";
  }
  report.seconds = watch.seconds();
  return space;
}

std::vector<int> paretoFront(const Matrix& points) {
  std::vector<int> order(static_cast<std::size_t>(points.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return points(a, 0) != points(b, 0) ? points(a, 0) > points(b, 0) : points(a, 1) > points(b, 1);
  });
  std::vector<int> front;
  double best = -std::numeric_limits<double>::infinity();
  for (const int i : order) {
    if (!(points(i, 1) > best)) continue;
    best = points(i, 1);
    front.push_back(i);
  }
  std::reverse(front.begin(), front.end());
  return front;
}

}  // namespace pliant::harmonic
