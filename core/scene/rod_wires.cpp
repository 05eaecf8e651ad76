#include "core/scene/rod_wires.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/geometry/wire_body.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/placed_geometry.hpp"

namespace pliant::scene {

using base::InputError;
using Eigen::Vector3d;
using geometry::BallSocket;
using geometry::WirePiece;

namespace {

/// Of the smaller side of a flat rod, with which its edges are rounded.
constexpr double edgeRounding = 1.0 / 8;

struct Segment {
  std::array<int, 2> nodes;
  WirePiece piece;
};

/// Rods that hang together.
struct Wire {
  std::string name;
  std::vector<Segment> segments;
};

Vector3d placeOf(const mechanics::Vector& positions, int node) { return positions.segment<3>(3 * node); }

WirePiece pieceOf(const Json& entry, const PartsSource& source, const std::array<int, 2>& nodes) {
  WirePiece piece{placeOf(source.positions, nodes[0]), placeOf(source.positions, nodes[1])};
  if (entry["type"] == "rod") {
    piece.rounding = 0.5 * entry["diameter"].get<double>();
    return piece;
  }
  for (const int node : nodes)
    if (placeOf(source.positions, node) != placeOf(source.model.restPositions, node))
      throw InputError(entry["name"], "Flat rods are made in their rest shape only.");
  const double width = entry["width"], height = entry["height"];
  piece.rounding = edgeRounding * std::min(width, height);
  piece.halfWidth = 0.5 * width - piece.rounding;
  piece.halfHeight = 0.5 * height - piece.rounding;
  const Vector3d axis = (piece.to - piece.from).normalized();
  Vector3d director;
  for (int i = 0; i < 3; ++i) director[i] = entry["director"][i];
  piece.widthDirection = (director - axis.dot(director) * axis).normalized();
  return piece;
}

/// Pieces that share a node are one wire.
std::vector<Wire> wiresOf(const PartsSource& source, std::vector<std::string>& remarks) {
  const Json& scene = source.scene.normalized();
  const auto geometries = placeGeometry(source.scene);
  std::vector<Wire> wires;
  std::map<int, std::size_t> wireOfNode;
  for (const Json& entry : scene["elements"]) {
    if (entry["type"] != "rod" && entry["type"] != "flat_rod") continue;
    if (entry.value("inner_diameter", 0.0) > 0)
      remarks.push_back("The tubes " + entry["name"].get<std::string>() + " are made solid.");
    const auto geometry = std::find_if(
        geometries.begin(), geometries.end(), [&](const PlacedGeometry& g) { return g.name == entry["geometry"]; });
    for (const auto& nodes : geometry->global(geometry->segments)) {
      std::size_t home = wires.size();
      for (const int node : nodes)
        if (const auto known = wireOfNode.find(node); known != wireOfNode.end()) home = std::min(home, known->second);
      if (home == wires.size()) wires.push_back({entry["name"], {}});
      wires[home].segments.push_back({nodes, pieceOf(entry, source, nodes)});
      for (const int node : nodes) {
        const auto [known, isNew] = wireOfNode.emplace(node, home);
        if (isNew || known->second == home) continue;
        const std::size_t other = known->second;
        auto& moved = wires[other].segments;
        wires[home].segments.insert(wires[home].segments.end(), moved.begin(), moved.end());
        moved.clear();
        for (auto& [at, wire] : wireOfNode)
          if (wire == other) wire = home;
      }
    }
  }
  std::erase_if(wires, [](const Wire& wire) { return wire.segments.empty(); });
  return wires;
}

/// Sockets for the masses at the nodes of a wire.
std::vector<BallSocket> socketsOf(const Wire& wire, const std::vector<WirePiece>& pieces, const PartsSource& source,
                                  const PartsRequest& request, std::vector<std::string>& remarks) {
  std::map<int, double> thickest;  // half of it, at each node
  for (const auto& [nodes, piece] : wire.segments)
    for (const int node : nodes)
      thickest[node] = std::max(thickest[node], piece.rounding + std::max(piece.halfWidth, piece.halfHeight));
  std::map<int, std::pair<double, std::string>> masses;
  for (const mechanics::PointMass& mass : source.model.pointMasses)
    for (const int node : mass.nodes)
      if (thickest.contains(node) && mass.mass > 0) {
        masses[node].first += mass.mass;
        masses[node].second = mass.name;
      }
  std::vector<BallSocket> sockets;
  for (const auto& [node, mass] : masses) {
    const double radius = 0.5 * ballDiameter(mass.first, request.density) + request.clearance;
    if (radius < 1.5 * thickest[node]) {
      remarks.push_back("The mass " + mass.second + " has no socket, since its ball is hardly thicker than the wire.");
      continue;
    }
    const Vector3d centre = placeOf(source.positions, node);
    for (const BallSocket& other : sockets)
      if ((other.centre - centre).norm() < other.radius + radius + request.wall)
        throw InputError(mass.second, "This mass and another one are so near that their balls do not have room.");
    sockets.push_back({centre, radius, request.wall, openDirection(pieces, centre, radius)});
  }
  return sockets;
}

}  // namespace

double ballDiameter(double mass, double density) { return std::cbrt(6 * mass / (std::numbers::pi * density)); }

std::vector<Part> rodWires(const PartsSource& source, const PartsRequest& request, base::ExecutionContext& context,
                           std::vector<std::string>& remarks) {
  std::vector<Part> parts;
  const std::vector<Wire> wires = wiresOf(source, remarks);
  for (const Wire& wire : wires) {
    context.reportProgress(static_cast<double>(parts.size()) / static_cast<double>(wires.size()), wire.name);
    std::vector<WirePiece> pieces;
    for (const Segment& segment : wire.segments) pieces.push_back(segment.piece);
    findStrands(pieces);
    const std::vector<BallSocket> sockets = socketsOf(wire, pieces, source, request, remarks);
    auto body = locate(wire.name, [&] { return meshWires(pieces, sockets, request.tolerance, context); });
    if (!body) return {};
    if (body->bodies > 1)
      throw InputError(wire.name, "The balls of its masses cut this wire into " + std::to_string(body->bodies) +
                                      " pieces; they need to be smaller, or farther apart.");
    parts.push_back({wire.name, std::move(body->mesh)});
    if (!sockets.empty())
      remarks.push_back(wire.name + " has " + std::to_string(sockets.size()) +
                        (sockets.size() == 1 ? " socket for a ball." : " sockets for balls."));
  }
  return parts;
}

}  // namespace pliant::scene
