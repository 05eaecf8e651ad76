#include "core/scene/detail_export.hpp"

#include "core/base/units.hpp"
#include "core/interlock/element_body.hpp"
#include "core/math/parallel.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/print_bodies.hpp"

namespace pliant::scene {

using base::InputError;

PatchReport exportPlaced(const MacroResult& result, double tolerance, double minimumClearance,
                         const std::filesystem::path& file, base::ExecutionContext& context) {
  const std::string& study = result.provenance.study;
  if (!result.placed) throw InputError(study, "This study has placed no elements; it does so with \"elements\".");
  const auto& [detail, before, check] = *result.placed;
  if (!check.holds()) throw InputError(study, "The placed elements overlap, or are linked otherwise than at rest.");
  PatchReport report;
  report.elements = static_cast<int>(detail.elements.size());
  report.leftOut = detail.leftOut;
  report.clearance = check.smallestDistance;
  if (report.clearance < minimumClearance)
    throw InputError(study, "Elements are " + base::formatQuantity(report.clearance, base::dimensions::length) +
                                " apart, but at least " +
                                base::formatQuantity(minimumClearance, base::dimensions::length) + " are asked for.");
  const auto& shapes = result.cell->shapes;
  std::vector<geometry::BodyMesh> bodies(shapes.size());
  locate(study, [&] {
    math::parallelFor(static_cast<int>(bodies.size()), [&](int i) {
      const auto index = static_cast<std::size_t>(i);
      bodies[index] = interlock::ElementBody(shapes[index]).mesh(tolerance);
    });
  });
  std::vector<geometry::BodyCopy> copies;
  for (std::size_t i = 0; i < detail.elements.size(); ++i)
    copies.push_back({result.cell->elements[static_cast<std::size_t>(detail.elements[i].element)].shape,
                      detail.state.rotations[i], detail.state.positions.col(static_cast<Eigen::Index>(i))});
  context.reportProgress(0.5);
  writeBodies(bodies, std::move(copies), file, report, context);
  return report;
}

}  // namespace pliant::scene
