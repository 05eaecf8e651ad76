#include "core/scene/detail_export.hpp"

#include "core/base/units.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/print_files.hpp"
#include "core/interlock/element_body.hpp"
#include "core/math/parallel.hpp"
#include "core/scene/input_error_location.hpp"

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
  std::vector<geometry::SurfaceMesh> meshes;
  std::vector<double> volumes;
  for (const geometry::BodyMesh& body : bodies) {
    report.deviation = std::max(report.deviation, body.fit.deviation);
    report.filled = std::max(report.filled, body.fit.filled);
    volumes.push_back(enclosedVolume(body.mesh));
    meshes.push_back(body.mesh);
  }
  std::vector<geometry::BodyCopy> copies;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < detail.elements.size(); ++i) {
    const int shape = result.cell->elements[static_cast<std::size_t>(detail.elements[i].element)].shape;
    const auto index = static_cast<std::size_t>(shape);
    const geometry::BodyCopy& copy = copies.emplace_back(
        geometry::BodyCopy{shape, detail.state.rotations[i], detail.state.positions.col(static_cast<Eigen::Index>(i))});
    report.triangles += static_cast<long>(meshes[index].triangles.size());
    report.volume += volumes[index];
    const Eigen::Matrix3Xd points = copy.rotation * meshes[index].points;
    box.extend(points.rowwise().minCoeff() + copy.position).extend(points.rowwise().maxCoeff() + copy.position);
  }
  report.size = box.sizes();
  for (geometry::BodyCopy& copy : copies) copy.position -= box.min();
  context.reportProgress(0.5);
  const std::string ending = file.extension().string();
  if (ending == ".stl")
    report.cancelled = !writePrintStl(meshes, copies, file, &context);
  else if (ending == ".3mf")
    writePrint3mf(meshes, copies, file);
  else
    geometry::writeMesh(assembled(meshes, copies), file);
  return report;
}

}  // namespace pliant::scene
