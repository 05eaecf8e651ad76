#include "core/geometry/surface_mesh.hpp"
#include "core/interlock/cell_surface.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/element_table.hpp"
#include "core/scene/interlock_result.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/result_folder.hpp"

namespace pliant::scene {

namespace {

void addAll(CsvWriter& csv, const Eigen::Vector3d& vector) {
  for (int i = 0; i < 3; ++i) csv.add(vector[i]);
}

std::string contactTable(const interlock::CellEquilibrium& rest) {
  CsvWriter csv;
  csv.add("element_a").add("element_b").add("shift_1").add("shift_2").add("gap [m]").add("force [strain/m]");
  for (const char* column : {"x [m]", "y [m]", "z [m]", "normal_x", "normal_y", "normal_z"}) csv.add(column);
  csv.endRow();
  for (const interlock::CellContactForce& contact : rest.contacts) {
    csv.add(contact.pair.a).add(contact.pair.b).add(contact.pair.shift[0]).add(contact.pair.shift[1]);
    csv.add(contact.gap).add(contact.force);
    addAll(csv, contact.place);
    addAll(csv, contact.normal);
    csv.endRow();
  }
  return csv.text();
}

}  // namespace

std::string StretchBoundaryResult::table() const {
  CsvWriter csv;
  for (const char* column :
       {"state", "direction_mean", "direction_deviator", "direction_shear", "distance", "strain_mean",
        "strain_deviator", "strain_shear", "green_xx", "green_yy", "green_xy", "remaining", "mean_gap [m]", "contacts",
        "iterations", "rest", "termination", "raised", "sees_beyond"})
    csv.add(column);
  csv.endRow();
  for (std::size_t i = 0; i < boundary.states.size(); ++i) {
    const interlock::BoundaryState& state = boundary.states[i];
    const Eigen::Vector3d strain = boundary.strainAt(static_cast<int>(i));
    csv.add(static_cast<long>(i));
    addAll(csv, boundary.mesh.directions[i]);
    csv.add(state.distance);
    addAll(csv, strain);
    addAll(csv, interlock::greenStrain(strain));
    csv.add(state.remaining).add(state.meanGap).add(state.contacts).add(state.iterations);
    csv.add(nameOf(state.kind)).add(base::toString(state.termination));
    csv.add(state.raised ? 1 : 0).add(state.seesBeyond ? 1 : 0).endRow();
  }
  return csv.text();
}

void CellTestResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  folder.writeFile("contacts.csv", contactTable(limit.equilibrium));
  folder.writeFile("elements.csv", elementTable(limit.equilibrium.state));
  if (!limit.equilibrium.state.rotations.empty())
    geometry::writeMesh(cellSurface(*cell, limit.equilibrium.state, 3, 3), folder.path("patch.ply"));
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

void FreeTravelResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  CsvWriter csv;
  for (const char* column : {"direction [rad]", "stretch", "compression", "free_travel", "stretch_remaining",
                             "compression_remaining", "stretch_termination", "compression_termination"})
    csv.add(column);
  csv.endRow();
  for (const interlock::FreeTravel& direction : directions) {
    const auto& [stretch, compression] = direction;
    csv.add(stretch.angle).add(stretch.strain).add(compression.strain).add(direction.travel());
    csv.add(stretch.equilibrium.remaining).add(compression.equilibrium.remaining);
    csv.add(base::toString(stretch.equilibrium.termination));
    csv.add(base::toString(compression.equilibrium.termination)).endRow();
  }
  folder.writeFile("free_travel.csv", csv.text());
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

void StretchGridResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  CsvWriter csv;
  for (const char* column : {"direction [rad]", "principal_wanted", "principal", "missed", "across_smallest",
                             "across_largest", "smallest_remaining", "largest_remaining", "smallest_contacts",
                             "largest_contacts", "smallest_termination", "largest_termination"})
    csv.add(column);
  csv.endRow();
  for (const interlock::GridSlice& slice : grid.slices) {
    const interlock::CellEquilibrium &low = slice.compressed.equilibrium, &high = slice.stretched.equilibrium;
    csv.add(slice.angle).add(slice.wanted).add(slice.principal).add(slice.missed ? 1 : 0);
    csv.add(slice.compressed.strain).add(slice.stretched.strain).add(low.remaining).add(high.remaining);
    csv.add(static_cast<long>(low.contacts.size())).add(static_cast<long>(high.contacts.size()));
    csv.add(base::toString(low.termination)).add(base::toString(high.termination)).endRow();
  }
  folder.writeFile("limits.csv", csv.text());
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

void StretchBoundaryResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  folder.writeFile("boundary.csv", table());
  geometry::SurfaceMesh mesh;
  mesh.points.resize(3, static_cast<Eigen::Index>(boundary.states.size()));
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    mesh.points.col(i) = interlock::greenStrain(boundary.strainAt(static_cast<int>(i)));
  mesh.triangles = boundary.mesh.triangles;
  geometry::writeMesh(mesh, folder.path("boundary.ply"));
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

}  // namespace pliant::scene
