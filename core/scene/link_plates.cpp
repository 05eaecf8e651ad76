#include "core/scene/link_plates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/geometry/plate.hpp"
#include "core/mechanics/mechanism.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/placed_geometry.hpp"
#include "core/scene/plate_layers.hpp"

namespace pliant::scene {

using base::InputError;
using Eigen::Vector2d;
using mechanics::AttachmentPoint;
using mechanics::Vector;

namespace {

/// Holes whose centres are nearer than this are one [m].
constexpr double samePlace = 1e-6;
/// Between plates that are laid flat, as a printer wants it [m].
constexpr double flatGap = 5e-3;

struct Link {
  std::string name;
  std::vector<int> joints;  ///< counted through the scene
  std::vector<std::array<AttachmentPoint, 2>> arms;
  std::vector<AttachmentPoint> springs;
};

/// Links that rigid angles join.
struct Plate {
  std::string name;
  std::vector<const Link*> links;
  std::set<int> joints;
};

class Mechanism {
 public:
  Mechanism(const PartsSource& source, const PartsRequest& request)
      : source_(source), request_(request), scene_(source.scene.normalized()) {
    const auto geometries = placeGeometry(source.scene);
    std::vector<std::vector<int>> angles;
    for (const Json& entry : scene_["elements"]) {
      if (entry["type"] != "link" && entry["type"] != "rigid_angle") continue;
      const auto geometry = std::find_if(
          geometries.begin(), geometries.end(), [&](const PlacedGeometry& g) { return g.name == entry["geometry"]; });
      std::vector<int> joints;
      for (const Json& joint : entry["joints"]) joints.push_back(geometry->nodes[joint.get<std::size_t>()]);
      if (entry["type"] == "link")
        links_.push_back({entry["name"], std::move(joints), {}, {}});
      else
        angles.push_back(std::move(joints));
    }
    if (links_.empty()) return;
    if (source.model.dimension != 2)
      throw InputError(links_.front().name, "Links are made as plates, for which the scene must have 2 dimensions.");
    for (const Json& spring : scene_["springs"])
      if (spring["type"] == "local")
        for (const char* end : {"from", "to"}) attach(spring[end]);
    weld(angles);
  }

  const std::vector<Plate>& plates() const { return plates_; }

  geometry::PlateOutline outline(const Plate& plate, const Vector& positions) const {
    const auto at = [&](const AttachmentPoint& point) -> Vector2d { return positionOf(point, 2, positions); };
    const auto joint = [&](int node) -> Vector2d { return positions.segment<2>(2 * node); };
    geometry::PlateOutline outline;
    outline.width = request_.width;
    const auto addHole = [&](const Vector2d& place, double diameter) {
      if (std::none_of(outline.holes.begin(), outline.holes.end(),
                       [&](const auto& hole) { return (hole.centre - place).norm() < samePlace; }))
        outline.holes.push_back({place, diameter});
    };
    for (const Link* link : plate.links) {
      std::vector<Vector2d>& hull = outline.hulls.emplace_back();
      for (const int node : link->joints) hull.push_back(joint(node));
      for (const auto& [from, to] : link->arms) outline.hulls.push_back({at(from), at(to)});
    }
    for (const int node : plate.joints)
      if (hasHole(plate, node)) addHole(joint(node), request_.hole);
    for (const Link* link : plate.links)
      for (const AttachmentPoint& spring : link->springs) addHole(at(spring), request_.springHole);
    return outline;
  }

  LayerRules layerRules() const {
    const int count = static_cast<int>(plates_.size());
    LayerRules rules;
    rules.apart.assign(plates_.size(), std::vector<char>(plates_.size(), 0));
    std::set<int> joints;
    for (const Plate& plate : plates_) joints.insert(plate.joints.begin(), plate.joints.end());
    std::vector<int> pinned;
    for (const int node : joints) {
      LayerRules::Pin pin;
      for (int p = 0; p < count; ++p)
        if (plates_[p].joints.contains(node)) pin.plates.push_back(p);
      if (pin.plates.size() < 2) continue;
      pinned.push_back(node);
      rules.pins.push_back(std::move(pin));
    }
    std::vector<const Vector*> moments{&source_.positions};
    for (const Vector& positions : source_.motion) moments.push_back(&positions);
    for (const Vector* positions : moments) {
      std::vector<geometry::PlateOutline> outlines;
      for (const Plate& plate : plates_) outlines.push_back(outline(plate, *positions));
      const auto meet = [&](const geometry::PlateOutline& a, const geometry::PlateOutline& b) {
        return distanceBetween(a, b) < request_.clearance;
      };
      for (int p = 0; p < count; ++p)
        for (int q = 0; q < p; ++q)
          if (!rules.apart[p][q] && meet(outlines[p], outlines[q])) rules.apart[p][q] = rules.apart[q][p] = 1;
      for (std::size_t i = 0; i < pinned.size(); ++i) {
        LayerRules::Pin& pin = rules.pins[i];
        const geometry::PlateOutline disc{{{positions->segment<2>(2 * pinned[i])}}, request_.hole, {}};
        for (int p = 0; p < count; ++p)
          if (!plates_[p].joints.contains(pinned[i]) && std::count(pin.kept.begin(), pin.kept.end(), p) == 0 &&
              meet(outlines[p], disc))
            pin.kept.push_back(p);
      }
    }
    return rules;
  }

 private:
  /// The end of a spring, if it is at a link: its hole, and an arm if it is beside the link.
  void attach(const Json& end) {
    if (end["type"] != "link") return;
    const auto link = std::find_if(links_.begin(), links_.end(), [&](const Link& l) { return l.name == end["link"]; });
    const Vector& rest = source_.model.restPositions;
    const int a = link->joints[0], b = link->joints[1];
    const auto at = [&](double along, double across) {
      return mechanics::attachedToLink(2, rest, a, b, along, across);
    };
    const double along = end["along"], across = end["across"];
    const double nearest = std::clamp(along, 0.0, (rest.segment<2>(2 * b) - rest.segment<2>(2 * a)).norm());
    link->springs.push_back(at(along, across));
    if (across != 0 || nearest != along) link->arms.push_back({at(nearest, 0), at(along, across)});
  }

  /// A rigid angle holds all links together that have two of its joints.
  void weld(const std::vector<std::vector<int>>& angles) {
    std::vector<std::size_t> first(links_.size());
    std::iota(first.begin(), first.end(), 0);
    for (const auto& angle : angles) {
      std::vector<std::size_t> members;
      for (std::size_t l = 0; l < links_.size(); ++l)
        if (std::count_if(links_[l].joints.begin(), links_[l].joints.end(),
                          [&](int joint) { return std::find(angle.begin(), angle.end(), joint) != angle.end(); }) >= 2)
          members.push_back(first[l]);
      if (members.empty()) continue;
      const std::size_t lowest = *std::min_element(members.begin(), members.end());
      for (std::size_t& group : first)
        if (std::find(members.begin(), members.end(), group) != members.end()) group = lowest;
    }
    for (std::size_t l = 0; l < links_.size(); ++l) {
      if (first[l] != l) continue;
      Plate& plate = plates_.emplace_back();
      for (std::size_t other = l; other < links_.size(); ++other) {
        if (first[other] != l) continue;
        plate.name += (plate.links.empty() ? "" : ", ") + links_[other].name;
        plate.links.push_back(&links_[other]);
        plate.joints.insert(links_[other].joints.begin(), links_[other].joints.end());
      }
    }
  }

  bool hasHole(const Plate& plate, int node) const {
    const auto has = [&](const Link* link) {
      return std::find(link->joints.begin(), link->joints.end(), node) != link->joints.end();
    };
    const bool turns =
        std::count_if(plates_.begin(), plates_.end(), [&](const Plate& p) { return p.joints.contains(node); }) > 1;
    const bool welded = std::count_if(plate.links.begin(), plate.links.end(), has) > 1;
    const bool bears = std::any_of(
        source_.model.pointMasses.begin(), source_.model.pointMasses.end(), [&](const mechanics::PointMass& mass) {
          return std::find(mass.nodes.begin(), mass.nodes.end(), node) != mass.nodes.end();
        });
    return turns || bears || !welded;
  }

  const PartsSource& source_;
  const PartsRequest& request_;
  const Json& scene_;
  std::vector<Link> links_;
  std::vector<Plate> plates_;
};

/// Turned so that the two farthest corners of the hulls lie along x.
void layAlong(const geometry::PlateOutline& outline, geometry::SurfaceMesh& mesh) {
  Vector2d longest = Vector2d::UnitX();
  double length = 0;
  for (const auto& first : outline.hulls)
    for (const auto& second : outline.hulls)
      for (const Vector2d& a : first)
        for (const Vector2d& b : second)
          if ((b - a).norm() > length) longest = b - a, length = longest.norm();
  longest.normalize();
  Eigen::Matrix2d turn;
  turn << longest[0], longest[1], -longest[1], longest[0];
  mesh.points.topRows<2>() = (turn * mesh.points.topRows<2>()).eval();
}

/// In rows of about the same length, the tallest first.
void laySideBySide(std::vector<Part>& parts) {
  std::vector<Eigen::AlignedBox3d> boxes;
  double area = 0, longest = 0;
  for (const Part& part : parts) {
    const Eigen::Vector3d low = part.mesh.points.rowwise().minCoeff(), high = part.mesh.points.rowwise().maxCoeff();
    const Eigen::Vector3d size = boxes.emplace_back(low, high).sizes();
    area += (size[0] + flatGap) * (size[1] + flatGap);
    longest = std::max(longest, size[0]);
  }
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return boxes[a].sizes()[1] > boxes[b].sizes()[1]; });
  const double rowLength = std::max(longest, std::sqrt(area));
  double x = 0, y = 0, rowHeight = 0;
  for (const std::size_t p : order) {
    const Eigen::Vector3d size = boxes[p].sizes();
    if (x > 0 && x + size[0] > rowLength) x = 0, y += rowHeight + flatGap, rowHeight = 0;
    parts[p].mesh.points.colwise() += Eigen::Vector3d(x, y, 0) - boxes[p].min();
    x += size[0] + flatGap;
    rowHeight = std::max(rowHeight, size[1]);
  }
}

}  // namespace

std::vector<Part> linkPlates(const PartsSource& source, const PartsRequest& request,
                             std::vector<std::string>& remarks) {
  const Mechanism mechanism(source, request);
  std::vector<Part> parts;
  for (const Plate& plate : mechanism.plates()) {
    const geometry::PlateOutline outline = mechanism.outline(plate, source.positions);
    Part& part = parts.emplace_back();
    part.name = plate.name;
    part.mesh = locate(plate.name, [&] { return makePlate(outline, request.thickness, request.tolerance); });
    if (request.flat) layAlong(outline, part.mesh);
  }
  if (parts.empty()) return parts;
  if (request.flat) {
    laySideBySide(parts);
    return parts;
  }
  LayerRules rules = mechanism.layerRules();
  auto layers = assignLayers(rules);
  if (!layers) {
    remarks.push_back("No order of layers keeps all pins clear: some plate lies in the way of one.");
    rules.pins.clear();
    layers = assignLayers(rules);
  }
  for (std::size_t p = 0; p < parts.size(); ++p)
    parts[p].mesh.points.row(2).array() += (*layers)[p] * (request.thickness + request.clearance);
  remarks.push_back(
      std::to_string(parts.size()) + " plates in " +
      std::to_string(*std::max_element(layers->begin(), layers->end()) + 1) + " layers; they do not meet " +
      (source.motion.empty() ? "at rest." : "at " + std::to_string(source.motion.size()) + " times of the motion."));
  return parts;
}

}  // namespace pliant::scene
