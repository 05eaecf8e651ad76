#include <cmath>

#include "core/scene/bending_studies.hpp"
#include "core/scene/patch_study.hpp"

namespace pliant::scene {

using base::TerminationType;

namespace {

class GravityBendingStudy final : public PatchStudy {
 public:
  using PatchStudy::PatchStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<GravityBendingResult>();
    result->patch = cut();
    result->direction = options_["direction"];
    const interlock::PatchSolver solver(*result->patch, equilibriumOptions());
    result->clamped = clampedElements(*result->patch, result->direction, options_["clamped_width"]);
    std::vector<bool> held(result->patch->elements.size(), false);
    for (const int element : result->clamped) held[static_cast<std::size_t>(element)] = true;
    for (int i = 0; i < 3; ++i) result->gravity[i] = options_["gravity"][i];
    interlock::PatchLoads loads;
    loads.forces = weightsOf(*result->patch, options_["density"], result->gravity);
    loads.clamped = result->clamped;
    for (const interlock::PointLoad& load : loads.forces) result->weight += load.force.norm();
    const interlock::CellState start = interlock::restState(*result->patch);
    const double perturbation = options_["perturbation"];
    result->rest =
        solver.solve(perturbation > 0 ? perturbedBeyond(solver, start, perturbation, held) : start, loads, &context);
    for (const interlock::CellContactForce& contact : result->rest.contacts)
      if (held[contact.pair.a] != held[contact.pair.b])
        result->reaction += (held[contact.pair.a] ? 1 : -1) * contact.force * contact.normal;
    if (result->rest.converged() && result->rest.kind == interlock::RestKind::unlimited)
      finish(*result, TerminationType::infeasible, "nothing holds the patch", watch);
    else
      finish(*result, result->rest.termination, result->rest.message, watch);
    context.reportProgress(1);
    if (observe) observe(result);
    return result;
  }

 private:
  /// Clamped elements stay where they are.
  interlock::CellState perturbedBeyond(const interlock::PatchSolver& solver, const interlock::CellState& start,
                                       double amplitude, const std::vector<bool>& held) const {
    return interlock::perturbedState(solver.contact(), start, solver.radius(), amplitude, options_["seed"],
                                     [&](Eigen::VectorXd velocity, double step) {
                                       for (std::size_t i = 0; i < held.size(); ++i)
                                         if (held[i]) velocity.segment<6>(6 * static_cast<Eigen::Index>(i)).setZero();
                                       return interlock::moved(start, velocity, step);
                                     });
  }
};

}  // namespace

std::unique_ptr<Study> makeGravityBendingStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                               const Json& options) {
  return std::make_unique<GravityBendingStudy>(scene, options);
}

}  // namespace pliant::scene
