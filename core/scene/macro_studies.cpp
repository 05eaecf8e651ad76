#include "core/scene/macro_studies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/hexagon_mesh.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/interlock/cell_surface.hpp"
#include "core/interlock/patch_equilibrium.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/interlock_study.hpp"
#include "core/scene/macro_result.hpp"

namespace pliant::scene {

namespace {

using base::TerminationType;
using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;
using mechanics::AdmissibleStrainSet;

/// (mean, deviator, shear) of the components xx, yy, xy.
Vector3d strainOfTensor(const Vector3d& tensor) {
  return {0.5 * (tensor[0] + tensor[1]), 0.5 * (tensor[0] - tensor[1]), tensor[2]};
}

/// From a surface whose coordinates are components of tensors. It is seen from the middle of what it encloses.
std::shared_ptr<const AdmissibleStrainSet> strainSetOf(geometry::SurfaceMesh boundary) {
  for (Index i = 0; i < boundary.points.cols(); ++i) boundary.points.col(i) = strainOfTensor(boundary.points.col(i));
  geometry::checkClosed(boundary);
  if (geometry::enclosedVolume(boundary) < 0)
    for (auto& triangle : boundary.triangles) std::swap(triangle[0], triangle[1]);
  const Vector3d middle = geometry::enclosedCentroid(boundary);
  return std::make_shared<const AdmissibleStrainSet>(std::move(boundary), middle);
}

Vector3d vectorOf(const Json& list) { return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()}; }
Vector2d planeOf(const Json& list) { return {list[0].get<double>(), list[1].get<double>()}; }

class MacroEquilibriumStudy final : public InterlockStudy {
 public:
  MacroEquilibriumStudy(const Scene& scene, const Json& options) : InterlockStudy(scene, options) {
    const Json& studies = scene.normalized()["studies"];
    std::size_t index = 0;
    while (studies[index]["name"] != options["name"]) ++index;
    place_ = scene.name() + ": /studies/" + std::to_string(index);
  }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<MacroResult>();
    interlock::MacroSheet sheet;
    sheet.mesh = locate(place_, [&] { return outline(); });
    sheet.angleOf.assign(sheet.mesh.triangles.size(), options_["angle"]);
    if (options_["native"] && (options_["shape"] == "mesh" || options_["angle"] != 0.0))
      throw base::InputError(place_, "A native patch is a disk, a hexagon or a rectangle along the material's axes.");
    context.setRange(0, options_.contains("stretch_limits") ? 0.05 : 0.6);
    sheet.materials = {material(context)};
    result->sheet = std::make_shared<const interlock::MacroSheet>(sheet);
    if (context.cancelRequested()) {
      result->state.positions = sheet.mesh.points.reshaped();
      judgeNothing(*result);
      finish(*result, TerminationType::cancelled, "The study was cancelled.", watch);
      return result;
    }
    interlock::MacroOptions macroOptions;
    macroOptions.limits = options_["limits"] == "barrier" ? mechanics::StrainLimitFunction::Kind::barrier
                                                          : mechanics::StrainLimitFunction::Kind::penalty;
    macroOptions.penalty = options_["penalty"];
    if (options_["limits"] == "penalty") macroOptions.maximumIterations = 5000;
    const interlock::MacroSimulation simulation =
        locate(place_, [&] { return interlock::MacroSimulation(sheet, macroOptions); });
    interlock::MacroLoads loads;
    loads.gravity = vectorOf(options_["gravity"]);
    loads.force = interlock::Vector::Zero(sheet.mesh.points.size());
    for (const Json& load : options_["loads"]) {
      result->loaded.push_back(nearest(sheet.mesh.points, planeOf(load["point"])));
      loads.force.segment<3>(3 * Index{result->loaded.back()}) += vectorOf(load["force"]);
    }
    for (const Json& clamp : options_["clamps"]) {
      const std::vector<int> nodes = within(sheet.mesh.points, clamp);
      loads.clamped.insert(loads.clamped.end(), nodes.begin(), nodes.end());
    }
    result->clamped = loads.clamped;
    context.setRange(options_.contains("stretch_limits") ? 0.05 : 0.6, options_["native"] ? 0.8 : 1);
    result->state = simulation.equilibrium(loads, nullptr, context);
    result->deflections =
        moved(result->state.positions.reshaped(3, sheet.mesh.points.cols()), sheet.mesh.points, result->loaded);
    TerminationType termination = result->state.report.termination;
    if (options_["native"] && termination != TerminationType::cancelled) {
      context.setRange(0.8, 1);
      result->native = nativePatch(context);
      compare(sheet.mesh, result->state.positions, *result->native);
      if (termination == TerminationType::converged) termination = result->native->rest.termination;
    }
    finish(*result, termination, result->state.report.message, watch);
    context.reportProgress(1);
    if (observe) observe(result);
    return result;
  }

 private:
  static void judgeNothing(MacroResult& result) {
    const auto count = static_cast<Index>(result.sheet->mesh.triangles.size());
    result.state.strains.stretch.setZero(3, count);
    result.state.strains.curvature.setZero(3, count);
    result.state.stretchGauge.setZero(count);
    result.state.bendingGauge.setZero(count);
    result.deflections.resize(3, 0);
  }

  [[noreturn]] static void needs(const char* shape, const char* key) {
    throw base::InputError("", std::string("A ") + shape + " needs \"" + key + "\".");
  }

  geometry::SurfaceMesh outline() const {
    const std::string shape = options_["shape"];
    const int rings = options_["rings"];
    if (shape == "hexagon" || shape == "disk") {
      if (!options_.contains("radius")) needs(shape.c_str(), "radius");
      return shape == "disk" ? geometry::makeDisk(options_["radius"], rings)
                             : geometry::makeHexagon(options_["radius"], rings);
    }
    if (shape == "rectangle") {
      if (!options_.contains("size")) needs("rectangle", "size");
      const double length = options_["size"][0], width = options_["size"][1], cell = std::max(length, width) / rings;
      geometry::SurfaceMesh mesh =
          geometry::makeGrid(length, width, std::max(1, static_cast<int>(std::lround(length / cell))),
                             std::max(1, static_cast<int>(std::lround(width / cell))));
      mesh.points.row(0).array() -= 0.5 * length;
      return mesh;
    }
    if (!options_.contains("mesh")) needs("sheet of the shape \"mesh\"", "mesh");
    geometry::SurfaceMesh mesh = geometry::readMesh(directory_ / options_["mesh"].get<std::string>(), 1);
    mesh =
        geometry::weldMesh(mesh, 1e-6 * (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm());
    const auto& [a, b, c] = mesh.triangles.front();
    const Vector3d normal =
        (mesh.points.col(b) - mesh.points.col(a)).head<3>().cross(Vector3d(mesh.points.col(c) - mesh.points.col(a)));
    if (normal.z() < 0)
      for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
    return mesh;
  }

  interlock::MacroMaterial material(base::ExecutionContext& context) const {
    interlock::MacroMaterial material;
    material.youngModulus = options_["young_modulus"];
    material.poissonRatio = options_["poisson_ratio"];
    material.density = options_["density"];
    material.thickness = options_.contains("thickness") ? options_["thickness"].get<double>() : heightOfElements();
    if (options_.contains("bending_limits")) material.bending = readSet("bending_limits");
    if (options_.contains("stretch_limits")) {
      material.stretch = readSet("stretch_limits");
      return material;
    }
    const interlock::CellSolver solver(*cell_, {});
    const interlock::StrainSpaceBoundary boundary = interlock::computeBoundary(solver, {}, context);
    if (context.cancelRequested()) return material;
    if (!boundary.isClosed())
      throw base::InputError(place_, "The material's limits of stretch could not all be found: " + boundary.message);
    geometry::SurfaceMesh mesh;
    mesh.triangles = boundary.mesh.triangles;
    mesh.points.resize(3, static_cast<Index>(boundary.states.size()));
    for (std::size_t i = 0; i < boundary.states.size(); ++i)
      mesh.points.col(static_cast<Index>(i)) = interlock::greenStrain(boundary.strainAt(static_cast<int>(i)));
    material.stretch = locate(place_, [&] { return strainSetOf(std::move(mesh)); });
    return material;
  }

  std::shared_ptr<const AdmissibleStrainSet> readSet(const char* key) const {
    return locate(place_ + "/" + key, [&] {
      geometry::SurfaceMesh mesh = geometry::readMesh(directory_ / options_[key].get<std::string>(), 1);
      const double size = (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
      return strainSetOf(geometry::weldMesh(mesh, 1e-6 * size));
    });
  }

  double heightOfElements() const {
    const geometry::SurfaceMesh mesh = cellSurface(*cell_, interlock::restState(*cell_), 1, 1, 0.5);
    return mesh.points.row(2).maxCoeff() - mesh.points.row(2).minCoeff();
  }

  static int nearest(const Eigen::Matrix3Xd& places, const Vector2d& point) {
    Index node = 0;
    (places.topRows<2>().colwise() - point).colwise().squaredNorm().minCoeff(&node);
    return static_cast<int>(node);
  }

  static std::vector<int> within(const Eigen::Matrix3Xd& places, const Json& clamp) {
    const Vector2d point = planeOf(clamp["point"]);
    const double radius = clamp["radius"];
    std::vector<int> found;
    for (Index i = 0; i < places.cols(); ++i)
      if ((places.col(i).head<2>() - point).norm() <= radius) found.push_back(static_cast<int>(i));
    return found.empty() ? std::vector<int>{nearest(places, point)} : found;
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
    loads.forces = interlock::weightsOf(*native.patch, nativeDensity(), vectorOf(options_["gravity"]));
    std::vector<int> loaded;
    for (const Json& load : options_["loads"]) {
      loaded.push_back(nearest(rest, planeOf(load["point"])));
      loads.forces.push_back({loaded.back(), vectorOf(load["force"]), Vector3d::Zero()});
    }
    for (const Json& clamp : options_["clamps"])
      for (const int element : within(rest, clamp))
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
    const double thickness = options_.contains("thickness") ? options_["thickness"].get<double>() : heightOfElements();
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

  std::string place_;
};

}  // namespace

std::unique_ptr<Study> makeMacroEquilibriumStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                                 const Json& options) {
  return std::make_unique<MacroEquilibriumStudy>(scene, options);
}

}  // namespace pliant::scene
