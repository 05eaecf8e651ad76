#include "core/scene/macro_studies.hpp"

#include <algorithm>
#include <cmath>

#include "core/interlock/patch_equilibrium.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/macro_placement.hpp"
#include "core/scene/macro_study.hpp"

namespace pliant::scene {

namespace {

using base::TerminationType;
using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;

class MacroEquilibriumStudy final : public MacroStudy {
 public:
  using MacroStudy::MacroStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    checkNative();
    interlock::MacroSheet sheet;
    const std::shared_ptr<MacroResult> result = begin(sheet, context);
    if (context.cancelRequested()) {
      judgeNothing(*result);
      finish(*result, TerminationType::cancelled, "The study was cancelled.", watch);
      return result;
    }
    interlock::MacroOptions macroOptions;
    macroOptions.limits = options_["limits"] == "barrier" ? mechanics::StrainLimitFunction::Kind::barrier
                                                          : mechanics::StrainLimitFunction::Kind::penalty;
    macroOptions.margin = options_["margin"];
    macroOptions.penalty = options_["penalty"];
    if (options_["limits"] == "penalty") macroOptions.maximumIterations = 5000;
    if (options_["elements"]) macroOptions.pathSpacing = placementSpacing(*cell_);
    const interlock::MacroSimulation simulation =
        locate(place_, [&] { return interlock::MacroSimulation(sheet, macroOptions, builder_.contact()); });
    const interlock::MacroLoads loads = builder_.loads(sheet, &result->loaded);
    const interlock::Vector start = builder_.start(sheet);
    result->clamped = loads.clamped;
    const double settled = options_["native"] ? 0.8 : options_["elements"] ? begun() + 0.1 : 1;
    context.setRange(begun(), settled);
    result->state = locate(place_, [&] { return simulation.equilibrium(loads, &start, context); });
    const Eigen::Matrix3Xd from = start.reshaped(3, sheet.mesh.points.cols());
    result->deflections = moved(result->state.positions.reshaped(3, sheet.mesh.points.cols()), from, result->loaded);
    TerminationType termination = result->state.report.termination;
    if (options_["native"] && termination != TerminationType::cancelled) {
      context.setRange(0.8, options_["elements"] ? 0.9 : 1);
      result->native = nativePatch(context);
      compare(sheet.mesh, result->state.positions, *result->native);
      if (termination == TerminationType::converged) termination = result->native->rest.termination;
    }
    std::string message = result->state.report.message;
    if (options_["elements"] && termination == TerminationType::converged) {
      context.setRange(options_["native"] ? 0.9 : settled, 1);
      std::vector<interlock::Vector> way = std::move(result->state.path);
      result->state.path.clear();
      if (way.empty()) way.push_back(start);
      way.push_back(result->state.positions);
      const PlacementOutcome outcome = placeElements(way, options_, place_, *result, context);
      termination = outcome.termination;
      message = outcome.message;
    }
    finish(*result, termination, message, watch);
    context.reportProgress(1);
    if (observe) observe(result);
    return result;
  }

 private:
  void checkNative() const {
    if (!options_["native"]) return;
    if (options_["shape"] == "mesh" || options_["shape"] == "outline" || options_["angle"] != 0.0 ||
        !options_["regions"].empty())
      throw base::InputError(place_, "A native patch is a disk, a hexagon or a rectangle along the material's axes.");
    if (!builder_.contact().bodies.empty() || options_["placement"] != Json(macroRestPlacement()))
      throw base::InputError(place_, "A native patch meets no bodies, and starts where its sheet rests.");
  }

  static Json macroRestPlacement() {
    return {{"position", {0.0, 0.0, 0.0}}, {"axis", {0.0, 0.0, 1.0}}, {"angle", 0.0}};
  }

  static Eigen::Matrix3Xd moved(const Eigen::Matrix3Xd& places, const Eigen::Matrix3Xd& rest,
                                const std::vector<int>& which) {
    return places(Eigen::all, which) - rest(Eigen::all, which);
  }

  MacroResult::Native nativePatch(base::ExecutionContext& context) const {
    const base::Stopwatch watch;
    interlock::PatchOutline patchOutline;
    const std::string shape = options_["shape"];
    patchOutline.centre = planeOf(options_["centre"]);
    constexpr double rim = 1 + 1e-6;  // elements on it belong to the patch
    if (shape == "rectangle") {
      patchOutline.kind = interlock::PatchOutline::Kind::rectangle;
      patchOutline.size = rim * planeOf(options_["size"]);
    } else {
      patchOutline.radius = rim * options_["radius"].get<double>();
    }
    MacroResult::Native native;
    native.patch = locate(
        place_, [&] { return std::make_shared<const interlock::UnitCell>(interlock::cutPatch(*cell_, patchOutline)); });
    Eigen::Matrix3Xd rest(3, static_cast<Index>(native.patch->elements.size()));
    for (Index i = 0; i < rest.cols(); ++i) rest.col(i) = native.patch->elements[static_cast<std::size_t>(i)].position;
    for (Index i = 0; i < rest.cols(); ++i)
      native.size = std::max(native.size, (rest.colwise() - rest.col(i)).colwise().norm().maxCoeff());
    interlock::EquilibriumOptions equilibrium = equilibriumOptions();
    equilibrium.looseTolerance = 1;
    equilibrium.maximumIterations = 5000;
    const interlock::PatchSolver solver(*native.patch, equilibrium);
    interlock::PatchLoads loads;
    // The same weight an area as the sheet has.
    loads.forces = interlock::weightsOf(*native.patch, nativeDensity(), spaceOf(options_["gravity"]));
    std::vector<int> loaded;
    for (const Json& load : options_["loads"]) {
      loaded.push_back(nearestOf(rest, planeOf(load["point"])));
      loads.forces.push_back({loaded.back(), spaceOf(load["force"]), Vector3d::Zero()});
    }
    for (const Json& clamp : options_["clamps"])
      for (const int element : nodesWithin(rest, clamp))
        if (std::find(loads.clamped.begin(), loads.clamped.end(), element) == loads.clamped.end())
          loads.clamped.push_back(element);
    native.rest = solver.solve(interlock::restState(*native.patch), loads, &context);
    native.deflections = moved(native.rest.state.positions, rest, loaded);
    native.seconds = watch.seconds();
    return native;
  }

  /// With which the elements weigh as much an area as the sheet.
  double nativeDensity() const {
    double volume = 0;
    for (const interlock::InterlockingElement& element : cell_->elements)
      volume += interlock::bodyMass(cell_->shapes[static_cast<std::size_t>(element.shape)]).volume;
    const double area = std::abs(cell_->lattice.determinant());
    const double thickness =
        options_.contains("thickness") ? options_["thickness"].get<double>() : MacroBuilder::heightOf(*cell_);
    return options_["density"].get<double>() * thickness * area / volume;
  }

  /// Where the sheet is at the elements' places, and how far from them.
  static void compare(const geometry::SurfaceMesh& mesh, const interlock::Vector& positions,
                      MacroResult::Native& native) {
    for (std::size_t i = 0; i < native.patch->elements.size(); ++i) {
      const Vector2d point = native.patch->elements[i].position.head<2>();
      for (const auto& [a, b, c] : mesh.triangles) {
        Eigen::Matrix2d edges;
        edges << (mesh.points.col(b) - mesh.points.col(a)).head<2>(),
            (mesh.points.col(c) - mesh.points.col(a)).head<2>();
        const Vector2d shares = edges.inverse() * (point - mesh.points.col(a).head<2>());
        constexpr double rounding = 1e-6;
        if (shares.minCoeff() < -rounding || shares.sum() > 1 + rounding) continue;
        const auto at = [&](int node) -> Vector3d { return positions.segment<3>(3 * Index{node}); };
        const Vector3d place = (1 - shares.sum()) * at(a) + shares[0] * at(b) + shares[1] * at(c);
        const double distance = (place - native.rest.state.positions.col(static_cast<Index>(i))).norm();
        native.meanDistance += distance;
        native.largestDistance = std::max(native.largestDistance, distance);
        ++native.compared;
        break;
      }
    }
    if (native.compared > 0) native.meanDistance /= native.compared;
  }
};

}  // namespace

std::unique_ptr<Study> makeMacroEquilibriumStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                                 const Json& options) {
  return std::make_unique<MacroEquilibriumStudy>(scene, options);
}

}  // namespace pliant::scene
