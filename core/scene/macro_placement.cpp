#include "core/scene/macro_placement.hpp"

#include "core/interlock/shared_lattice.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/interlock_builder.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/macro_builder.hpp"

namespace pliant::scene {

using interlock::UnitCell;

namespace {

/// Of the shortest translation of the lattice.
constexpr double stepOfWay = 0.5;

interlock::DetailMaterials materialsOf(const interlock::MacroSheet& sheet) {
  return {sheet.materialOf, static_cast<int>(sheet.materials.size())};
}

}  // namespace

std::shared_ptr<const UnitCell> placedCell(const Scene& scene, const Json& options, const std::string& place,
                                           const std::shared_ptr<const UnitCell>& cell) {
  const Json& regions = options["regions"];
  if (regions.empty()) return cell;
  std::vector<UnitCell> materials{*cell};
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const std::string own = childPointer(place + "/regions", i);
    if (regions[i]["angle"] != options["angle"])
      throw base::InputError(own + "/angle",
                             "Elements cannot be placed where a region's material is turned against the sheet's, since "
                             "they share no lattice.");
    materials.push_back(regions[i].contains("cell") ? buildCell(scene, regions[i]["cell"]) : *cell);
    locate(own, [&] { interlock::sharedLattice({materials.front(), materials.back()}); });
  }
  return std::make_shared<const UnitCell>(interlock::sharedLattice(materials));
}

double placementSpacing(const UnitCell& cell) { return stepOfWay * cell.lattice.colwise().norm().minCoeff(); }

PlacementOutcome placeElements(const std::vector<interlock::Vector>& way, const Json& options, const std::string& place,
                               MacroResult& result, base::ExecutionContext& context) {
  const geometry::SurfaceMesh& mesh = result.sheet->mesh;
  const UnitCell& cell = *result.cell;
  const interlock::SheetDetailer detailer = locate(place + "/elements", [&] {
    return interlock::SheetDetailer(
        cell, mesh, options["angle"], planeOf(options["centre"]), {}, materialsOf(*result.sheet));
  });
  std::vector<Eigen::Matrix3Xd> path;
  for (const interlock::Vector& positions : way) path.emplace_back(positions.reshaped(3, mesh.points.cols()));
  const double reach = cell.smallestRadius();
  result.placed.emplace();
  base::ExecutionContext silent;
  const interlock::SheetDetail rest = detailer.follow({path.front()}, silent);
  result.placed->before = checkDetail(cell, rest.elements, rest.state, reach);
  if (!options["regions"].empty() && !result.placed->before.holds())
    throw base::InputError(place + "/regions",
                           "Elements of different regions do not hold each other at rest: some "
                           "overlap, or are linked otherwise than in their materials.");
  result.placed->detail = detailer.follow(path, context);
  result.placed->check = checkDetail(cell, result.placed->detail.elements, result.placed->detail.state, reach);
  PlacementOutcome outcome{result.placed->detail.termination, result.placed->detail.message};
  if (outcome.termination == base::TerminationType::converged && !result.placed->check.holds())
    outcome = {base::TerminationType::failed, "Placed elements overlap, or are linked otherwise than at rest."};
  return outcome;
}

}  // namespace pliant::scene
