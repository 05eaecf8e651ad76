#include "core/interlock/element_families.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/interlock/elliptic_wire.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;

Eigen::Matrix2d squareLattice(double spacing) { return spacing * Eigen::Matrix2d::Identity(); }

Eigen::Matrix2d hexagonalLattice(double spacing) {
  return spacing * (Eigen::Matrix2d() << 1, 0.5, 0, 0.5 * std::sqrt(3.0)).finished();
}

/// Adds `count` rings around the centre, the first at the angle `first`; returns of how many pieces each is made.
int addRings(const Rosette& rosette, int count, double first, ElementShape& shape) {
  int bundle = 0;
  for (int i = 0; i < count; ++i) {
    const double angle = first + i * 2 * pi / count;
    const Vector3d outward(std::cos(angle), std::sin(angle), 0), along(-std::sin(angle), std::cos(angle), 0);
    const Vector3d normal = std::sin(rosette.lean) * along + std::cos(rosette.lean) * Vector3d::UnitZ();
    const auto pieces = ellipticRing(rosette.distance * outward, normal, rosette.ring, rosette.wire, rosette.aspect);
    shape.pieces.insert(shape.pieces.end(), pieces.begin(), pieces.end());
    bundle = static_cast<int>(pieces.size());
  }
  return bundle;
}

/// A ring about z.
ElementShape flatRing(double ring, double wireRadius, double aspect) {
  return {"ring", ellipticRing(Vector3d::Zero(), Vector3d::UnitZ(), ring, wireRadius, aspect)};
}

int bundleOf(const UnitCell& cell) { return static_cast<int>(cell.shapes[0].pieces.size()); }

/// A cell of a single element at the origin.
UnitCell cellOf(const std::string& name, const ElementShape& shape, const Eigen::Matrix2d& lattice) {
  UnitCell cell;
  cell.name = name;
  cell.shapes = {shape};
  cell.elements = {{0, Vector3d::Zero(), Matrix3d::Identity()}};
  cell.lattice = lattice;
  return cell;
}

}  // namespace

UnitCell fourInOne(const FourInOne& parameters) {
  const auto& [ring, wireRadius, width, height, tilt, aspect] = parameters;
  UnitCell cell;
  cell.name = "4-in-1";
  cell.shapes = {flatRing(ring, wireRadius, aspect)};
  const auto turned = [](double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix(); };
  cell.elements = {{0, Vector3d::Zero(), turned(-tilt)}, {0, {0.5 * width, 0.5 * height, 0}, turned(tilt)}};
  cell.lattice << width, 0, 0, height;
  cell.links = bundledLinks(
      {{0, 0, 1, 0, {-1, -1}, 1}, {0, 0, 1, 0, {-1, 0}, 1}, {0, 0, 1, 0, {0, -1}, -1}, {0, 0, 1, 0, {0, 0}, -1}},
      bundleOf(cell));
  return cell;
}

UnitCell threefold(const Rosette& parameters) {
  ElementShape shape{"threefold", {}};
  const int bundle = addRings(parameters, 3, pi / 6, shape);
  UnitCell cell = cellOf("threefold", shape, hexagonalLattice(parameters.spacing));
  cell.links = bundledLinks({{0, 0, 0, 2, {0, 1}, -1}, {0, 2, 0, 1, {1, -1}, -1}, {0, 0, 0, 1, {1, 0}, -1}}, bundle);
  return cell;
}

UnitCell squareRosette(const Rosette& parameters) {
  ElementShape shape{"rosette", {}};
  const int bundle = addRings(parameters, 4, 0, shape);
  UnitCell cell = cellOf("square rosette", shape, squareLattice(parameters.spacing));
  cell.links = bundledLinks({{0, 1, 0, 3, {0, 1}, -1}, {0, 0, 0, 2, {1, 0}, -1}}, bundle);
  return cell;
}

UnitCell torusKnot(const TorusKnot& parameters) {
  const auto& [p, q, a, b, c, wireRadius, spacing] = parameters;
  const ElementShape shape{"torus knot", {wire(ClosedCurve::torusCurve(p, q, a, b, c), wireRadius)}};
  UnitCell cell = cellOf("torus knot", shape, squareLattice(spacing));
  cell.links = {{0, 0, 0, 0, {0, 1}, 1}, {0, 0, 0, 0, {1, 0}, 1}};
  return cell;
}

UnitCell scaleMail(const ScaleMail& parameters) {
  ElementShape shape{"scale", {}};
  const int bundle = addRings(parameters.rings, 6, 0, shape);
  const Vector3d top(0, 0, parameters.plateHeight);
  shape.pieces.push_back(capsule(Vector3d::Zero(), top, parameters.hubRadius));
  Eigen::Matrix3Xd corners(3, 6);
  for (int i = 0; i < 6; ++i) {
    const double angle = pi / 6 + i * pi / 3, distance = parameters.plateInradius / std::cos(pi / 6);
    corners.col(i) = top + distance * Vector3d(std::cos(angle), std::sin(angle), 0);
  }
  shape.pieces.push_back(roundedPolygon(corners, parameters.plateRadius));
  UnitCell cell = cellOf("scale mail", shape, hexagonalLattice(parameters.rings.spacing));
  cell.links = bundledLinks({{0, 1, 0, 4, {0, 1}, -1}, {0, 5, 0, 2, {1, -1}, -1}, {0, 0, 0, 3, {1, 0}, -1}}, bundle);
  return cell;
}

UnitCell ringNet(const RingNet& parameters) {
  const auto& [ring, wireRadius, spacing, aspect] = parameters;
  UnitCell cell;
  cell.name = "ring net";
  cell.shapes = {flatRing(ring, wireRadius, aspect)};
  const auto upright = [](const Vector3d& axis) { return Eigen::AngleAxisd(pi / 2, axis).toRotationMatrix(); };
  cell.elements = {{0, Vector3d::Zero(), Matrix3d::Identity()},
                   {0, {0.5 * spacing, 0, 0}, upright(Vector3d::UnitX())},
                   {0, {0, 0.5 * spacing, 0}, upright(Vector3d::UnitY())}};
  cell.lattice = squareLattice(spacing);
  cell.links = bundledLinks(
      {{0, 0, 1, 0, {-1, 0}, 1}, {0, 0, 1, 0, {0, 0}, -1}, {0, 0, 2, 0, {0, -1}, 1}, {0, 0, 2, 0, {0, 0}, -1}},
      bundleOf(cell));
  return cell;
}

}  // namespace pliant::interlock
