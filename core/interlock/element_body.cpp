#include "core/interlock/element_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/interlock/part_distance.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Vector3d;

double thinnestOf(const ElementShape& shape) {
  double thinnest = std::numeric_limits<double>::infinity();
  for (const DilatedPiece& piece : shape.pieces) thinnest = std::min(thinnest, halfThickness(piece));
  return thinnest;
}

}  // namespace

ElementBody::ElementBody(const ElementShape& shape)
    : name_(shape.name),
      halfThickness_(thinnestOf(shape)),
      parts_(shape, 0.262),
      isPlainMesh_(shape.pieces.size() == 1 && isClosedMesh(shape.pieces[0]) && shape.pieces[0].radius == 0) {
  for (const DilatedPiece& piece : shape.pieces) {
    if (!isClosedMesh(piece)) continue;
    const SimplexSet& set = std::get<SimplexSet>(piece.core);
    solids_.push_back({set.corners, set.triangles, {}, {}});
  }
}

geometry::SurfacePlace ElementBody::at(const Vector3d& place) const {
  static const Part point{PartKind::point, 0, 0};
  PlacedPart query{&point, nullptr, {}};
  query.corners.colwise() = place;
  double least = std::numeric_limits<double>::infinity(), radius = 0;
  Vector3d away = Vector3d::UnitX();  // from the nearest place of the core
  const auto boundOf = [&](int node) {
    const Ball& ball = parts_.nodes()[node].ball;
    return (place - ball.centre).norm() - ball.radius;
  };
  std::vector<std::pair<double, int>> stack{{boundOf(0), 0}};
  while (!stack.empty()) {
    const auto [bound, index] = stack.back();
    stack.pop_back();
    if (bound >= least) continue;
    const ElementParts::Node& node = parts_.nodes()[index];
    if (node.part < 0) {
      auto [first, second] = node.children;
      double firstBound = boundOf(first), secondBound = boundOf(second);
      if (firstBound > secondBound) std::swap(first, second), std::swap(firstBound, secondBound);
      stack.push_back({secondBound, second});
      stack.push_back({firstBound, first});
      continue;
    }
    const Part& part = parts_.parts()[node.part];
    if (part.bounds) continue;  // what it bounds is there
    PlacedPart own{&part, part.kind == PartKind::arc ? &parts_.curves()[part.curve] : nullptr, {}};
    for (int i = 0; i < 3; ++i) own.corners.col(i) = parts_.corners().col(part.corners[i]);
    Vector3d between;
    if (part.kind == PartKind::arc) {
      between = -closestArcs(own, query, Vector3d::Zero()).between;
    } else {
      const SimplexParts simplices = simplexParts(query, own, Vector3d::Zero());
      between = simplices.corners * geometry::closestPoints(simplices.kind, simplices.corners).weights;
    }
    const double distance = between.norm() - part.radius;
    if (distance < least) least = distance, radius = part.radius, away = between;
  }
  const double length = away.norm();
  const Vector3d direction = length > 0 ? Vector3d(away / length) : Vector3d::UnitX();
  for (const geometry::SurfaceMesh& solid : solids_)
    if (geometry::windingNumber(solid, place) > 0) return {-length - radius, place - (length + radius) * direction};
  return {least, place + (radius - length) * direction};
}

geometry::BodyMesh ElementBody::mesh(double tolerance) const {
  if (isPlainMesh_) return {solids_.front(), {}, 1};
  // Chords between the points of a cell's size are near the tolerance for the thinnest piece.
  const double cell = std::min(0.5 * halfThickness_, std::sqrt(6 * halfThickness_ * tolerance));
  Eigen::AlignedBox3d box;
  for (const ElementParts::Node& node : parts_.nodes())
    if (node.part >= 0) {
      const Vector3d extent = Vector3d::Constant(node.ball.radius);
      box.extend(node.ball.centre - extent).extend(node.ball.centre + extent);
    }
  try {
    geometry::BodyMesh result =
        geometry::meshBody([this](const Vector3d& place) { return at(place); }, box, cell, tolerance);
    if (result.bodies > 1)
      throw base::InputError(
          "", "it falls apart into " + std::to_string(result.bodies) + " bodies, since its pieces do not overlap");
    return result;
  } catch (const base::InputError& error) {
    throw base::InputError("", "element \"" + name_ + "\" cannot be made a mesh: " + error.problem());
  }
}

}  // namespace pliant::interlock
