#include "core/scene/macro_builder.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/hexagon_mesh.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/geometry/mesh_kernel.hpp"
#include "core/geometry/outline_mesh.hpp"
#include "core/interlock/cell_surface.hpp"
#include "core/interlock/strain_space_boundary.hpp"
#include "core/scene/body_builder.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/interlock_builder.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/outline_file.hpp"

namespace pliant::scene {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using mechanics::AdmissibleStrainSet;

namespace {

/// (mean, deviator, shear) of the components xx, yy, xy.
Vector3d strainOfTensor(const Vector3d& tensor) {
  return {0.5 * (tensor[0] + tensor[1]), 0.5 * (tensor[0] - tensor[1]), tensor[2]};
}

/// From a surface whose coordinates are components of tensors. It is seen from the middle of what it encloses, or if
/// not all of it is, from where all is seen best.
std::shared_ptr<const AdmissibleStrainSet> strainSetOf(geometry::SurfaceMesh boundary) {
  for (Index i = 0; i < boundary.points.cols(); ++i) boundary.points.col(i) = strainOfTensor(boundary.points.col(i));
  geometry::checkClosed(boundary);
  if (geometry::enclosedVolume(boundary) < 0)
    for (auto& triangle : boundary.triangles) std::swap(triangle[0], triangle[1]);
  Vector3d middle = geometry::enclosedCentroid(boundary);
  if (geometry::kernelDepth(boundary, middle) <= 0) middle = geometry::deepestKernelPoint(boundary).point;
  return std::make_shared<const AdmissibleStrainSet>(std::move(boundary), middle);
}

[[noreturn]] void needs(const char* shape, const char* key) {
  throw base::InputError("", std::string("A ") + shape + " needs \"" + key + "\".");
}

Matrix2Xd polygonFrom(const Json& corners) {
  Matrix2Xd polygon(2, static_cast<Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i) polygon.col(static_cast<Index>(i)) = planeOf(corners[i]);
  return polygon;
}

double sizeOf(const geometry::SurfaceMesh& mesh) {
  return (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
}

}  // namespace

Vector3d spaceOf(const Json& list) { return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()}; }
Vector2d planeOf(const Json& list) { return {list[0].get<double>(), list[1].get<double>()}; }

int nearestOf(const Eigen::Matrix3Xd& places, const Vector2d& point) {
  Index node = 0;
  (places.topRows<2>().colwise() - point).colwise().squaredNorm().minCoeff(&node);
  return static_cast<int>(node);
}

std::vector<int> nodesWithin(const Eigen::Matrix3Xd& places, const Json& entry) {
  const Vector2d point = planeOf(entry["point"]);
  const double radius = entry["radius"];
  std::vector<int> found;
  for (Index i = 0; i < places.cols(); ++i)
    if ((places.col(i).head<2>() - point).norm() <= radius) found.push_back(static_cast<int>(i));
  return found.empty() ? std::vector<int>{nearestOf(places, point)} : found;
}

MacroBuilder::MacroBuilder(const Scene& scene, const Json& options, std::string place)
    : scene_(scene), options_(options), place_(std::move(place)) {}

interlock::MacroSheet MacroBuilder::sheet(const interlock::UnitCell& cell, double until,
                                          base::ExecutionContext& context) const {
  interlock::MacroSheet sheet;
  sheet.mesh = locate(place_, [&] { return outline(); });
  const Json& regions = options_["regions"];
  sheet.angleOf.assign(sheet.mesh.triangles.size(), options_["angle"]);
  sheet.materialOf.assign(sheet.mesh.triangles.size(), 0);
  std::vector<interlock::UnitCell> cells;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const std::string place = childPointer(place_ + "/regions", i);
    for (const int triangle : locate(place, [&] { return regionTriangles(regions[i], sheet.mesh); })) {
      sheet.materialOf[static_cast<std::size_t>(triangle)] = static_cast<int>(i) + 1;
      sheet.angleOf[static_cast<std::size_t>(triangle)] = regions[i]["angle"];
    }
    cells.push_back(regions[i].contains("cell") ? buildCell(scene_, regions[i]["cell"]) : cell);
  }
  const double share = until / static_cast<double>(regions.size() + 1);
  for (std::size_t i = 0; i <= regions.size(); ++i) {
    context.setRange(share * static_cast<double>(i), share * static_cast<double>(i + 1));
    sheet.materials.push_back(
        i == 0 ? material(options_, cell, place_, context)
               : material(regions[i - 1], cells[i - 1], childPointer(place_ + "/regions", i - 1), context));
  }
  return sheet;
}

std::vector<int> regionTriangles(const Json& region, const geometry::SurfaceMesh& mesh) {
  const int count = static_cast<int>(mesh.triangles.size());
  std::vector<int> found;
  if (region.contains("triangles")) {
    for (const Json& entry : region["triangles"]) {
      found.push_back(entry);
      if (found.back() >= count)
        throw base::InputError(
            "", "There is no triangle " + std::to_string(found.back()) + " among " + std::to_string(count) + ".");
    }
    return found;
  }
  const Matrix2Xd polygon = polygonFrom(region["corners"]);
  for (int t = 0; t < count; ++t) {
    const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(t)];
    const Vector3d middle = (mesh.points.col(a) + mesh.points.col(b) + mesh.points.col(c)) / 3;
    if (geometry::isInPolygon(polygon, middle.head<2>())) found.push_back(t);
  }
  if (found.empty()) throw base::InputError("", "No triangle has its middle in this region.");
  return found;
}

geometry::SurfaceMesh MacroBuilder::outline() const {
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
  if (shape == "outline") {
    std::vector<Matrix2Xd> polygons;
    if (options_.contains("corners")) polygons.push_back(polygonFrom(options_["corners"]));
    if (options_.contains("outline"))
      polygons = readOutline(scene_.directory() / options_["outline"].get<std::string>());
    if (polygons.empty()) needs("sheet of the shape \"outline\"", "corners\" or \"outline");
    for (const Json& hole : options_["holes"]) polygons.push_back(polygonFrom(hole));
    const Vector2d box = polygons.front().rowwise().maxCoeff() - polygons.front().rowwise().minCoeff();
    return geometry::meshOutline(polygons, box.maxCoeff() / rings);
  }
  if (!options_.contains("mesh")) needs("sheet of the shape \"mesh\"", "mesh");
  geometry::SurfaceMesh mesh = geometry::readMesh(scene_.directory() / options_["mesh"].get<std::string>(), 1);
  mesh = geometry::weldMesh(mesh, 1e-6 * sizeOf(mesh));
  const auto& [a, b, c] = mesh.triangles.front();
  const Vector3d normal =
      (mesh.points.col(b) - mesh.points.col(a)).head<3>().cross(Vector3d(mesh.points.col(c) - mesh.points.col(a)));
  if (normal.z() < 0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  return mesh;
}

interlock::MacroMaterial MacroBuilder::material(const Json& keys, const interlock::UnitCell& cell,
                                                const std::string& place, base::ExecutionContext& context) const {
  interlock::MacroMaterial material;
  material.youngModulus = keys["young_modulus"];
  material.poissonRatio = keys["poisson_ratio"];
  material.density = keys["density"];
  material.thickness = keys.contains("thickness") ? keys["thickness"].get<double>() : heightOf(cell);
  if (keys.contains("bending_limits")) material.bending = readSet(keys, "bending_limits", place);
  if (keys.contains("stretch_limits")) {
    material.stretch = readSet(keys, "stretch_limits", place);
    return material;
  }
  const interlock::CellSolver solver(cell, {});
  const interlock::StrainSpaceBoundary boundary = interlock::computeBoundary(solver, {}, context);
  if (context.cancelRequested()) return material;
  if (!boundary.isClosed())
    throw base::InputError(place, "The material's limits of stretch could not all be found: " + boundary.message);
  geometry::SurfaceMesh mesh;
  mesh.triangles = boundary.mesh.triangles;
  mesh.points.resize(3, static_cast<Index>(boundary.states.size()));
  for (std::size_t i = 0; i < boundary.states.size(); ++i)
    mesh.points.col(static_cast<Index>(i)) = interlock::greenStrain(boundary.strainAt(static_cast<int>(i)));
  material.stretch = locate(place, [&] { return strainSetOf(std::move(mesh)); });
  return material;
}

std::shared_ptr<const AdmissibleStrainSet> MacroBuilder::readSet(const Json& keys, const char* key,
                                                                 const std::string& place) const {
  return locate(place + "/" + key, [&] {
    const geometry::SurfaceMesh mesh = geometry::readMesh(scene_.directory() / keys[key].get<std::string>(), 1);
    return strainSetOf(geometry::weldMesh(mesh, 1e-6 * sizeOf(mesh)));
  });
}

double MacroBuilder::heightOf(const interlock::UnitCell& cell) {
  const geometry::SurfaceMesh mesh = cellSurface(cell, interlock::restState(cell), 1, 1, 0.5);
  return mesh.points.row(2).maxCoeff() - mesh.points.row(2).minCoeff();
}

interlock::MacroContact MacroBuilder::contact() const {
  const Json& contact = scene_.normalized()["contact"];
  return {buildBodies(scene_), contact["distance"], contact["self_contact"], contact["friction"]};
}

interlock::MacroLoads MacroBuilder::loads(const interlock::MacroSheet& sheet, std::vector<int>* loaded) const {
  interlock::MacroLoads loads;
  loads.gravity = spaceOf(options_["gravity"]);
  loads.force = interlock::Vector::Zero(sheet.mesh.points.size());
  for (const Json& load : options_["loads"]) {
    const int node = nearestOf(sheet.mesh.points, planeOf(load["point"]));
    if (loaded) loaded->push_back(node);
    loads.force.segment<3>(3 * Index{node}) += spaceOf(load["force"]);
  }
  for (const Json& clamp : options_["clamps"]) {
    const std::vector<int> nodes = nodesWithin(sheet.mesh.points, clamp);
    loads.clamped.insert(loads.clamped.end(), nodes.begin(), nodes.end());
  }
  return loads;
}

std::vector<interlock::MacroGrip> MacroBuilder::grips(const interlock::MacroSheet& sheet) const {
  std::vector<interlock::MacroGrip> grips;
  for (std::size_t i = 0; i < options_["grips"].size(); ++i) {
    const Json& entry = options_["grips"][i];
    interlock::MacroGrip& grip = grips.emplace_back();
    grip.nodes = nodesWithin(sheet.mesh.points, entry);
    grip.path = motionOf(entry);
    for (std::size_t k = 1; k < grip.path.size(); ++k)
      if (!(grip.path[k].time > grip.path[k - 1].time))
        throw base::InputError(
            childPointer(childPointer(place_ + "/grips", i) + "/path", k), "Keyframes must ascend in time.");
    if (entry.contains("release")) grip.release = entry["release"].get<double>();
  }
  return grips;
}

interlock::Vector MacroBuilder::start(const interlock::MacroSheet& sheet) const {
  const Json& placement = options_["placement"];
  const Vector3d axis = spaceOf(placement["axis"]);
  if (axis.isZero(0)) throw base::InputError(place_ + "/placement/axis", "A direction must not be zero.");
  const Vector3d turn = placement["angle"].get<double>() * axis.normalized();
  const mechanics::Keyframe keyframe{0, spaceOf(placement["position"]), turn};
  return mechanics::placementAt({keyframe}, 0).apply(sheet.mesh.points, Vector3d::Zero()).reshaped();
}

}  // namespace pliant::scene
