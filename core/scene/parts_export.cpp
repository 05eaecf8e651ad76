#include "core/scene/parts_export.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/print_files.hpp"
#include "core/geometry/tet_mesh.hpp"
#include "core/geometry/thick_surface.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/link_plates.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/rod_wires.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

template <std::size_t corners>
using Elements = std::vector<std::array<int, corners>>;

/// Element indices by the parts that hang together, in the order of their first elements.
template <std::size_t corners>
std::vector<std::vector<std::size_t>> connected(const Elements<corners>& elements, int nodeCount) {
  std::vector<int> parent(static_cast<std::size_t>(nodeCount));
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<int>(i);
  const auto root = [&](int node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const auto& element : elements)
    for (const int node : element) parent[root(node)] = root(element[0]);
  std::map<int, std::size_t> index;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto [entry, isNew] = index.emplace(root(elements[e][0]), groups.size());
    if (isNew) groups.emplace_back();
    groups[entry->second].push_back(e);
  }
  return groups;
}

/// The names of the elements `owners` of some of a part's pieces, each once.
std::string joinedNames(const Json& elements, const std::vector<int>& owners, const std::vector<std::size_t>& pieces) {
  std::string names;
  std::set<int> seen;
  for (const std::size_t piece : pieces)
    if (seen.insert(owners[piece]).second)
      names += (names.empty() ? "" : ", ") + elements[owners[piece]]["name"].get<std::string>();
  return names;
}

/// What is made of the elements of some types on one geometry.
const mechanics::DisplayPart* partOf(const mechanics::Model& model, const Json& element) {
  const auto part = std::find_if(model.parts.begin(), model.parts.end(),
                                 [&](const mechanics::DisplayPart& p) { return p.name == element["geometry"]; });
  return part == model.parts.end() ? nullptr : &*part;
}

/// All triangles with elements, and their thickness.
struct Shells {
  Elements<3> triangles;
  std::vector<double> thickness;
  std::vector<int> owners;  ///< the first element of each
};

/// Elements that bend only lie on a membrane as a rule, whose thickness it is then.
Shells shellsOf(const Json& elements, const mechanics::Model& model) {
  Shells shells;
  for (const mechanics::DisplayPart& part : model.parts) {
    std::vector<double> stretching(part.triangles.size(), 0), bending = stretching;
    int owner = -1;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const Json& element = elements[e];
      const std::string type = element["type"];
      const bool bendsOnly = type == "bending";
      if ((type != "shell" && type != "membrane" && !bendsOnly) || partOf(model, element) != &part) continue;
      if (owner < 0) owner = static_cast<int>(e);
      const double thickness = element["thickness"];
      const Json factors = element.value("thickness_factors", Json::array());
      for (std::size_t t = 0; t < part.triangles.size(); ++t)
        (bendsOnly ? bending : stretching)[t] += thickness * (factors.empty() ? 1 : factors[t].get<double>());
    }
    if (owner < 0) continue;
    for (std::size_t t = 0; t < part.triangles.size(); ++t) {
      shells.triangles.push_back(part.triangles[t]);
      shells.thickness.push_back(stretching[t] > 0 ? stretching[t] : bending[t]);
      shells.owners.push_back(owner);
    }
  }
  return shells;
}

void addShells(const Json& elements, const mechanics::Model& model, const Eigen::Matrix3Xd& points,
               std::vector<Part>& parts) {
  const Shells shells = shellsOf(elements, model);
  for (const auto& group : connected(shells.triangles, model.nodeCount())) {
    geometry::SurfaceMesh middle{points, {}, {}, {}};
    std::vector<double> thickness;
    for (const std::size_t t : group) {
      middle.triangles.push_back(shells.triangles[t]);
      thickness.push_back(shells.thickness[t]);
    }
    const std::string name = joinedNames(elements, shells.owners, group);
    parts.push_back({name, locate(name, [&] { return geometry::thickenSurface(middle, thickness); })});
  }
}

void addSolids(const Json& elements, const mechanics::Model& model, const Eigen::Matrix3Xd& points,
               std::vector<Part>& parts) {
  Elements<4> tetrahedra;
  std::vector<int> owners;
  std::set<const mechanics::DisplayPart*> seen;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (elements[e]["type"] != "solid") continue;
    const mechanics::DisplayPart* part = partOf(model, elements[e]);
    if (!seen.insert(part).second) continue;
    tetrahedra.insert(tetrahedra.end(), part->tetrahedra.begin(), part->tetrahedra.end());
    owners.resize(tetrahedra.size(), static_cast<int>(e));
  }
  for (const auto& group : connected(tetrahedra, model.nodeCount())) {
    Elements<4> own;
    for (const std::size_t t : group) own.push_back(tetrahedra[t]);
    own = geometry::orientTetrahedra({points, std::move(own), {}});
    const geometry::SurfaceMesh surface{points, geometry::boundaryTriangles(own), {}, {}};
    parts.push_back({joinedNames(elements, owners, group), geometry::withoutLoosePoints(surface)});
  }
}

Eigen::AlignedBox3d boxOf(const geometry::SurfaceMesh& mesh) {
  return {Eigen::Vector3d(mesh.points.rowwise().minCoeff()), Eigen::Vector3d(mesh.points.rowwise().maxCoeff())};
}

std::string sizeText(const Eigen::Vector3d& size) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    text += (axis > 0 ? " x " : "") + base::formatQuantity(size[axis], base::dimensions::length);
  return text;
}

}  // namespace

std::vector<Part> makeParts(const PartsSource& source, const PartsRequest& request, base::ExecutionContext& context,
                            std::vector<std::string>& remarks) {
  checkRequest(request);
  const Json& elements = source.scene.normalized()["elements"];
  const Eigen::Matrix3Xd points = surfaceAt(source.model, source.positions).points;
  return locate(source.scene.name(), [&] {
    std::vector<Part> parts;
    addShells(elements, source.model, points, parts);
    addSolids(elements, source.model, points, parts);
    for (Part& plate : linkPlates(source, request, remarks)) parts.push_back(std::move(plate));
    for (Part& wire : rodWires(source, request, context, remarks)) parts.push_back(std::move(wire));
    if (context.cancelRequested()) return std::vector<Part>();
    if (parts.empty()) throw InputError("", "This scene has no shells, solids, links or rods that could be made.");
    for (const Part& part : parts) locate(part.name, [&] { geometry::checkSolid(part.mesh); });
    return parts;
  });
}

std::optional<PartsReport> exportParts(const PartsSource& source, const PartsRequest& request,
                                       const std::filesystem::path& file, base::ExecutionContext& context) {
  PartsReport report;
  std::vector<std::string> names;
  std::vector<geometry::SurfaceMesh> meshes;
  std::vector<geometry::BodyCopy> copies;
  Eigen::AlignedBox3d box;
  for (Part& part : makeParts(source, request, context, report.remarks)) {
    const Eigen::AlignedBox3d own = boxOf(part.mesh);
    box.extend(own);
    report.parts.push_back(
        {part.name, static_cast<long>(part.mesh.triangles.size()), geometry::enclosedVolume(part.mesh), own.sizes()});
    copies.push_back({static_cast<int>(copies.size()), Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()});
    meshes.push_back(std::move(part.mesh));
    names.push_back(std::move(part.name));
  }
  if (context.cancelRequested()) return std::nullopt;
  report.size = box.sizes();
  for (geometry::BodyCopy& copy : copies) copy.position = -box.min();
  const std::string ending = file.extension().string();
  if (ending == ".stl")
    writePrintStl(meshes, copies, file);
  else if (ending == ".3mf")
    writePrint3mf(meshes, copies, file, names);
  else
    geometry::writeMesh(assembled(meshes, copies), file);
  return report;
}

std::vector<std::string> linesOf(const PartsReport& report) {
  std::vector<std::string> lines;
  for (const PartsReport::Entry& part : report.parts) {
    char volume[32];
    std::snprintf(volume, sizeof volume, "%.4g", part.volume * 1e6);
    lines.push_back(part.name + ": " + sizeText(part.size) + ", " + volume + " cm^3, " +
                    std::to_string(part.triangles) + " triangles");
  }
  lines.insert(lines.end(), report.remarks.begin(), report.remarks.end());
  lines.push_back(std::to_string(report.parts.size()) + (report.parts.size() == 1 ? " body, " : " bodies, ") +
                  sizeText(report.size) + "; checked: closed, normals outwards, no body cuts itself");
  return lines;
}

}  // namespace pliant::scene
