#include "core/scene/print_bodies.hpp"

#include <algorithm>

#include "core/geometry/closed_mesh.hpp"

namespace pliant::scene {

void writeBodies(const std::vector<geometry::BodyMesh>& bodies, std::vector<geometry::BodyCopy> copies,
                 const std::filesystem::path& file, PatchReport& report, base::ExecutionContext& context) {
  std::vector<geometry::SurfaceMesh> meshes;
  std::vector<double> volumes;
  for (const geometry::BodyMesh& body : bodies) {
    report.deviation = std::max(report.deviation, body.fit.deviation);
    report.filled = std::max(report.filled, body.fit.filled);
    volumes.push_back(body.mesh.triangles.empty() ? 0 : enclosedVolume(body.mesh));
    meshes.push_back(body.mesh);
  }
  Eigen::AlignedBox3d box;
  for (const geometry::BodyCopy& copy : copies) {
    const auto body = static_cast<std::size_t>(copy.body);
    report.triangles += static_cast<long>(meshes[body].triangles.size());
    report.volume += volumes[body];
    const Eigen::Matrix3Xd points = copy.rotation * meshes[body].points;
    box.extend(points.rowwise().minCoeff() + copy.position).extend(points.rowwise().maxCoeff() + copy.position);
  }
  report.size = box.sizes();
  for (geometry::BodyCopy& copy : copies) copy.position -= box.min();
  const std::string ending = file.extension().string();
  if (ending == ".stl")
    report.cancelled = !writePrintStl(meshes, copies, file, &context);
  else if (ending == ".3mf")
    writePrint3mf(meshes, copies, file);
  else
    geometry::writeMesh(assembled(meshes, copies), file);
}

}  // namespace pliant::scene
