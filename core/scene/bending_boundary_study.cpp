#include "core/interlock/bending_boundary.hpp"
#include "core/scene/bending_studies.hpp"
#include "core/scene/boundary_study.hpp"
#include "core/scene/patch_study.hpp"

namespace pliant::scene {

namespace {

class BendingBoundaryStudy final : public BoundaryStudy<PatchStudy, BendingBoundaryResult> {
 public:
  using BoundaryStudy::BoundaryStudy;

 private:
  void withSubject(BendingBoundaryResult& result, const Use& use) const override {
    result.patch = cut();
    const interlock::PatchSolver solver(*result.patch, equilibriumOptions());
    use(interlock::BentPatch(solver, bendingOptions()));
  }

  interlock::BoundaryOptions boundaryOptions() const override {
    interlock::BoundaryOptions options;
    options.subdivisions = options_["subdivisions"];
    options.perturbation = options_["perturbation"];
    options.seed = options_["seed"];
    options.testStarShape = options_["test_star_shape"];
    return options;
  }
};

}  // namespace

std::unique_ptr<Study> makeBendingBoundaryStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                                const Json& options) {
  return std::make_unique<BendingBoundaryStudy>(scene, options);
}

}  // namespace pliant::scene
