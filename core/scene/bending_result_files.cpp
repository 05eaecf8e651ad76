#include "core/interlock/cell_surface.hpp"
#include "core/scene/bending_result.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/element_table.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/result_folder.hpp"

namespace pliant::scene {

namespace {

void addComponents(CsvWriter& csv, const Eigen::Vector3d& vector) {
  for (int i = 0; i < 3; ++i) csv.add(vector[i]);
}

/// Columns of one limit; what a fold reached is there too, but its outcome says so.
void addLimitHeads(CsvWriter& csv) {
  for (const char* column :
       {"outcome", "curvature [1/m]", "orthogonal_curvature [1/m]", "k_xx [1/m]", "k_yy [1/m]", "k_xy [1/m]",
        "remaining [1/m]", "mean_gap [m]", "remote_share", "steepest_slope", "iterations", "termination"})
    csv.add(column);
}

void addBendingLimit(CsvWriter& csv, const interlock::BendingLimit& limit) {
  csv.add(nameOf(limit.kind)).add(limit.curvature).add(limit.orthogonal);
  addComponents(csv, curvatureTensor(limit.equilibrium.state.strain));
  csv.add(limit.equilibrium.remaining).add(limit.equilibrium.meanGap).add(limit.remoteShare).add(limit.steepest);
  csv.add(limit.equilibrium.iterations).add(base::toString(limit.equilibrium.termination));
}

}  // namespace

void PatchResult::writeConfiguration(ResultFolder& folder, const interlock::CellEquilibrium& rest) const {
  CsvWriter contacts;
  for (const char* column :
       {"element_a", "element_b", "gap [m]", "force", "x [m]", "y [m]", "z [m]", "normal_x", "normal_y", "normal_z"})
    contacts.add(column);
  contacts.endRow();
  for (const interlock::CellContactForce& contact : rest.contacts) {
    contacts.add(contact.pair.a).add(contact.pair.b).add(contact.gap).add(contact.force);
    addComponents(contacts, contact.place);
    addComponents(contacts, contact.normal);
    contacts.endRow();
  }
  folder.writeFile("contacts.csv", contacts.text());
  folder.writeFile("elements.csv", elementTable(rest.state));
  if (rest.state.rotations.empty()) return;
  interlock::CellState state = rest.state;
  state.strain.setZero();  // which is no stretch here
  geometry::writeMesh(cellSurface(*patch, state, 1, 1, 0.2), folder.path("patch.ply"));
}

void BendingTestResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  writeConfiguration(folder, limit.equilibrium);
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

void CurvatureLimitsResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  CsvWriter csv;
  csv.add("direction [rad]").add("bend");
  addLimitHeads(csv);
  csv.endRow();
  for (const interlock::BendingLimits& limits : directions)
    for (const auto& [side, limit] : {std::pair{"up", &limits.up}, {"down", &limits.down}}) {
      csv.add(limit->angle).add(side);
      addBendingLimit(csv, *limit);
      csv.endRow();
    }
  folder.writeFile("curvature_limits.csv", csv.text());
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

void BendingSizeResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  CsvWriter csv;
  csv.add("radius [m]").add("elements").add("test");
  addLimitHeads(csv);
  csv.endRow();
  for (const Size& size : sizes)
    for (std::size_t i = 0; i < names.size(); ++i) {
      csv.add(size.radius).add(size.elements).add(names[i]);
      addBendingLimit(csv, size.limits[i]);
      csv.endRow();
    }
  folder.writeFile("bending_size.csv", csv.text());
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

std::string BendingBoundaryResult::table() const {
  CsvWriter csv;
  for (const char* column : {"state", "direction_mean", "direction_deviator", "direction_twist", "distance [1/m]",
                             "k_xx [1/m]", "k_yy [1/m]", "k_xy [1/m]", "remaining [1/m]", "mean_gap [m]", "contacts",
                             "iterations", "rest", "termination", "raised", "sees_beyond"})
    csv.add(column);
  csv.endRow();
  for (std::size_t i = 0; i < boundary.states.size(); ++i) {
    const interlock::BoundaryState& state = boundary.states[i];
    csv.add(static_cast<long>(i));
    addComponents(csv, boundary.mesh.directions[i]);
    csv.add(state.distance);
    addComponents(csv, curvatureTensor(boundary.strainAt(static_cast<int>(i))));
    csv.add(state.remaining).add(state.meanGap).add(state.contacts).add(state.iterations);
    csv.add(state.kind == interlock::RestKind::unlimited ? "folded" : nameOf(state.kind));
    csv.add(base::toString(state.termination)).add(state.raised ? 1 : 0).add(state.seesBeyond ? 1 : 0).endRow();
  }
  return csv.text();
}

void BendingBoundaryResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  geometry::SurfaceMesh mesh;
  mesh.points.resize(3, static_cast<Eigen::Index>(boundary.states.size()));
  mesh.triangles = boundary.mesh.triangles;
  for (std::size_t i = 0; i < boundary.states.size(); ++i)
    mesh.points.col(static_cast<Eigen::Index>(i)) = curvatureTensor(boundary.strainAt(static_cast<int>(i)));
  folder.writeFile("boundary.csv", table());
  geometry::writeMesh(mesh, folder.path("boundary.ply"));
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

void GravityBendingResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  writeConfiguration(folder, rest);
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

}  // namespace pliant::scene
