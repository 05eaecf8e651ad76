#include "core/scene/native_patch.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "core/base/stopwatch.hpp"
#include "core/scene/input_error_location.hpp"

namespace pliant::scene {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// With which the elements weigh as much an area as the sheet.
double nativeDensity(const interlock::UnitCell& cell, const Json& options) {
  double volume = 0;
  for (const interlock::InterlockingElement& element : cell.elements)
    volume += interlock::bodyMass(cell.shapes[static_cast<std::size_t>(element.shape)]).volume;
  const double area = std::abs(cell.lattice.determinant());
  const double thickness =
      options.contains("thickness") ? options["thickness"].get<double>() : MacroBuilder::heightOf(cell);
  return options["density"].get<double>() * thickness * area / volume;
}

/// Where the sheet is at the elements' places, and how far from them.
void compareWithSheet(const geometry::SurfaceMesh& mesh, const interlock::Vector& positions, NativeComparison& native) {
  native.compared = 0;
  native.meanDistance = native.largestDistance = 0;
  for (std::size_t i = 0; i < native.patch->elements.size(); ++i) {
    const Vector2d point = native.patch->elements[i].position.head<2>();
    for (const auto& [a, b, c] : mesh.triangles) {
      Eigen::Matrix2d edges;
      edges << (mesh.points.col(b) - mesh.points.col(a)).head<2>(), (mesh.points.col(c) - mesh.points.col(a)).head<2>();
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

}  // namespace

interlock::UnitCell nativePatchOf(const interlock::UnitCell& cell, const Json& options) {
  interlock::PatchOutline outline;
  outline.centre = planeOf(options["centre"]);
  constexpr double rim = 1 + 1e-6;  // elements on it belong to the patch
  if (options["shape"] == "rectangle") {
    outline.kind = interlock::PatchOutline::Kind::rectangle;
    outline.size = rim * planeOf(options["size"]);
  } else {
    outline.radius = rim * options["radius"].get<double>();
  }
  return interlock::cutPatch(cell, outline);
}

NativePatch::NativePatch(const interlock::UnitCell& cell, const Json& options, const std::string& place,
                         const interlock::EquilibriumOptions& equilibrium) {
  comparison_.patch =
      locate(place, [&] { return std::make_shared<const interlock::UnitCell>(nativePatchOf(cell, options)); });
  const interlock::UnitCell& patch = *comparison_.patch;
  rest_.resize(3, static_cast<Index>(patch.elements.size()));
  for (Index i = 0; i < rest_.cols(); ++i) rest_.col(i) = patch.elements[static_cast<std::size_t>(i)].position;
  for (Index i = 0; i < rest_.cols(); ++i)
    comparison_.size = std::max(comparison_.size, (rest_.colwise() - rest_.col(i)).colwise().norm().maxCoeff());
  comparison_.rest.state = interlock::restState(patch);
  interlock::EquilibriumOptions patient = equilibrium;
  patient.looseTolerance = 1;
  patient.maximumIterations = 5000;
  solver_ = std::make_unique<const interlock::PatchSolver>(patch, patient);
  // The same weight an area as the sheet has.
  loads_.forces = interlock::weightsOf(patch, nativeDensity(cell, options), spaceOf(options["gravity"]));
  for (const Json& load : options["loads"]) {
    loaded_.push_back(nearestOf(rest_, planeOf(load["point"])));
    loads_.forces.push_back({loaded_.back(), spaceOf(load["force"]), Vector3d::Zero()});
  }
  for (const Json& clamp : options["clamps"])
    for (const int element : nodesWithin(rest_, clamp))
      if (std::find(loads_.clamped.begin(), loads_.clamped.end(), element) == loads_.clamped.end())
        loads_.clamped.push_back(element);
}

void NativePatch::load(double part, const geometry::SurfaceMesh& mesh, const interlock::Vector& positions,
                       const base::ExecutionContext& context) {
  const base::Stopwatch watch;
  interlock::PatchLoads loads = loads_;
  for (interlock::PointLoad& load : loads.forces) load.force *= part;
  comparison_.rest = solver_->solve(comparison_.rest.state, loads, &context);
  comparison_.deflections = comparison_.rest.state.positions(Eigen::all, loaded_) - rest_(Eigen::all, loaded_);
  compareWithSheet(mesh, positions, comparison_);
  comparison_.seconds += watch.seconds();
}

}  // namespace pliant::scene
