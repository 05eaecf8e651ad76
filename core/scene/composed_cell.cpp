#include "core/scene/composed_cell.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/geometry/closed_mesh.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;
using base::Json;
using Eigen::Vector3d;
using interlock::ClosedCurve;

namespace {

Vector3d tripleFrom(const Json& list) { return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()}; }

/// Not zero.
Vector3d axisFrom(const Json& list, const std::string& pointer) {
  const Vector3d axis = tripleFrom(list);
  if (!(axis.norm() > 0)) throw InputError(pointer, "A direction must not be zero.");
  return axis.normalized();
}

/// Of an entry that may have a "rotation".
Eigen::Matrix3d rotationFrom(const Json& entry, const std::string& pointer) {
  if (!entry.contains("rotation")) return Eigen::Matrix3d::Identity();
  const Json& rotation = entry["rotation"];
  const Vector3d axis = axisFrom(rotation["axis"], pointer + "/rotation/axis");
  return Eigen::AngleAxisd(rotation["angle"], axis).toRotationMatrix();
}

ClosedCurve moved(const ClosedCurve& curve, const Vector3d& by) { return {curve.centre() + by, curve.harmonics()}; }

interlock::SimplexSet simplicesFrom(const Json& entry) {
  interlock::SimplexSet set;
  set.corners.resize(3, static_cast<Eigen::Index>(entry["corners"].size()));
  for (std::size_t i = 0; i < entry["corners"].size(); ++i)
    set.corners.col(static_cast<Eigen::Index>(i)) = tripleFrom(entry["corners"][i]);
  set.points = entry["points"].get<std::vector<int>>();
  set.segments = entry["segments"].get<std::vector<std::array<int, 2>>>();
  set.triangles = entry["triangles"].get<std::vector<std::array<int, 3>>>();
  set.closed = entry["closed"];
  return set;
}

/// Corners that only look joined are made one, since surfaces made of them are open.
geometry::SurfaceMesh weldedMesh(const std::filesystem::path& file, double scale) {
  const geometry::SurfaceMesh read = geometry::readMesh(file, scale);
  const double size = (read.points.rowwise().maxCoeff() - read.points.rowwise().minCoeff()).norm();
  return geometry::weldMesh(read, 1e-6 * size);
}

interlock::DilatedPiece pieceFrom(const Json& entry, const std::string& pointer,
                                  const std::filesystem::path& directory) {
  const std::string type = entry["type"];
  const double radius = entry["radius"];
  if (type == "mesh") {
    geometry::SurfaceMesh mesh = locate(pointer + "/file", [&] {
      geometry::SurfaceMesh welded =
          weldedMesh(directory / std::filesystem::path(entry["file"].get<std::string>()), entry["scale"]);
      geometry::checkOneSolid(welded);
      return welded;
    });
    mesh.points = (rotationFrom(entry, pointer) * mesh.points).colwise() + tripleFrom(entry["center"]);
    return interlock::dilatedMesh(mesh, radius);
  }
  if (type == "simplices") return {simplicesFrom(entry), radius};
  const Vector3d center = tripleFrom(entry["center"]);
  if (type == "circle")
    return wire(
        ClosedCurve::circle(center, axisFrom(entry["normal"], pointer + "/normal"), entry["ring_radius"]), radius);
  if (type == "ellipse")
    return wire(ClosedCurve::ellipse(center, tripleFrom(entry["first"]), tripleFrom(entry["second"])), radius);
  if (type == "torus_curve") {
    const auto curve = ClosedCurve::torusCurve(entry["p"], entry["q"], entry["a"], entry["b"], entry["c"]);
    return wire(moved(curve.rotated(rotationFrom(entry, pointer)), center), radius);
  }
  std::vector<ClosedCurve::Harmonic> harmonics;
  for (const Json& term : entry["terms"])
    harmonics.push_back({term["order"], tripleFrom(term["cosine"]), tripleFrom(term["sine"])});
  return wire(ClosedCurve(center, harmonics), radius);
}

}  // namespace

interlock::UnitCell composedCell(const Json& entry, const std::string& pointer,
                                 const std::filesystem::path& directory) {
  interlock::UnitCell cell;
  for (int i = 0; i < 2; ++i)
    for (int axis = 0; axis < 2; ++axis) cell.lattice(axis, i) = entry["lattice"][i][axis];
  for (std::size_t i = 0; i < entry["shapes"].size(); ++i) {
    const Json& shape = entry["shapes"][i];
    const std::string place = childPointer(pointer + "/shapes", i);
    interlock::ElementShape& made = cell.shapes.emplace_back();
    made.name = shape["name"];
    for (std::size_t k = 0; k < shape["pieces"].size(); ++k)
      made.pieces.push_back(pieceFrom(shape["pieces"][k], childPointer(place + "/pieces", k), directory));
    if (shape.contains("contact_length")) made.contactLength = shape["contact_length"];
    locate(place, [&] { checkShape(made); });
  }
  for (std::size_t i = 0; i < entry["elements"].size(); ++i) {
    const Json& element = entry["elements"][i];
    const std::string place = childPointer(pointer + "/elements", i);
    const auto named = std::find_if(cell.shapes.begin(), cell.shapes.end(), [&](const interlock::ElementShape& shape) {
      return shape.name == element["shape"];
    });
    if (named == cell.shapes.end())
      throw InputError(
          place + "/shape", "There is no shape named " + quote(element["shape"].get<std::string>()) + " in this cell.");
    cell.elements.push_back(
        {static_cast<int>(named - cell.shapes.begin()), tripleFrom(element["position"]), rotationFrom(element, place)});
  }
  for (const Json& link : entry["links"])
    cell.links.push_back({link["a"], link["piece_a"], link["b"], link["piece_b"],
                          link["shift"].get<std::array<int, 2>>(), link["number"], link["handle_a"], link["handle_b"]});
  return cell;
}

}  // namespace pliant::scene
