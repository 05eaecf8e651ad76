#include "core/scene/mechanism_builders.hpp"

#include <algorithm>
#include <optional>

#include "core/base/error.hpp"
#include "core/mechanics/mechanism.hpp"
#include "core/mechanics/prescribed_motion.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {
namespace {

using base::InputError;
using mechanics::AttachmentPoint;
using mechanics::Vector;

/// An entry's joints, counted through the scene.
std::vector<int> jointsOf(const Json& entry, const std::string& pointer, const PlacedGeometry& geometry) {
  std::vector<int> joints;
  for (std::size_t i = 0; i < entry["joints"].size(); ++i) {
    const int node = entry["joints"][i];
    if (node >= geometry.nodeCount())
      throw InputError(childPointer(pointer + "/joints", i), "There is no node " + std::to_string(node) +
                                                                 "; the geometry " + quote(geometry.name) + " has " +
                                                                 std::to_string(geometry.nodeCount()) + ".");
    joints.push_back(geometry.nodes[static_cast<std::size_t>(node)]);
  }
  return joints;
}

void addBar(const ElementContext& context, const std::vector<int>& joints) {
  mechanics::Model& model = context.model;
  locate(context.pointer + "/joints", [&] {
    for (const auto& energy :
         mechanics::makeRigidBar(model.dimension, model.restPositions, joints, context.entry["stiffness"]))
      model.energies.push_back(energy);
  });
}

int nodeOf(const MechanismContext& context, const Json& entry, const char* key, const std::string& pointer) {
  return selectNode(entry[key], pointer + "/" + key, context.geometries);
}

/// One end of a local spring, and the point of its link that is nearest to it.
struct SpringEnd {
  AttachmentPoint point;
  std::optional<AttachmentPoint> nearestOfLink;
};

SpringEnd endOf(const MechanismContext& context, const Json& end, const std::string& pointer) {
  const int dimension = context.model.dimension;
  if (end["type"] == "node")
    return {mechanics::attachedToNode(dimension, selectNode(end["at"], pointer + "/at", context.geometries)), {}};
  if (end["type"] == "place") {
    const auto place = end["position"].get<std::vector<double>>();
    return {mechanics::fixedPlace(Vector::Map(place.data(), dimension)), {}};
  }
  const Json& elements = context.scene["elements"];
  const auto link =
      std::find_if(elements.begin(), elements.end(), [&](const Json& e) { return e["name"] == end["link"]; });
  if ((*link)["type"] != "link")
    throw InputError(pointer + "/link", "The element " + quote(end["link"].get<std::string>()) + " is no link.");
  const auto geometry = std::find_if(context.geometries.begin(), context.geometries.end(),
                                     [&](const PlacedGeometry& g) { return g.name == (*link)["geometry"]; });
  const int a = geometry->nodes[(*link)["joints"][0].get<std::size_t>()];
  const int b = geometry->nodes[(*link)["joints"][1].get<std::size_t>()];
  const Vector& rest = context.model.restPositions;
  const auto at = [&](double along, double across) {
    return mechanics::attachedToLink(dimension, rest, a, b, along, across);
  };
  const double along = end["along"], across = end["across"];
  SpringEnd attached{at(along, across), {}};
  const double length = (rest.segment(b * dimension, dimension) - rest.segment(a * dimension, dimension)).norm();
  const double nearest = std::clamp(along, 0.0, length);
  if (across != 0 || nearest != along) attached.nearestOfLink = at(nearest, 0);
  return attached;
}

}  // namespace

void addLink(const ElementContext& context) {
  const std::vector<int> joints = jointsOf(context.entry, context.pointer, context.geometry);
  addBar(context, joints);
  mechanics::addBarMass(context.model.dimension, context.model.restPositions, joints, context.entry["mass"],
                        context.massMatrix, context.mass);
  for (std::size_t i = 1; i < joints.size(); ++i) context.part.segments.push_back({joints[i - 1], joints[i]});
}

void addRigidAngle(const ElementContext& context) {
  addBar(context, jointsOf(context.entry, context.pointer, context.geometry));
}

void addLocalSpring(const MechanismContext& context, const Json& entry, const std::string& pointer) {
  mechanics::Model& model = context.model;
  const SpringEnd from = locate(pointer + "/from", [&] { return endOf(context, entry["from"], pointer + "/from"); });
  const SpringEnd to = locate(pointer + "/to", [&] { return endOf(context, entry["to"], pointer + "/to"); });
  const auto place = [&](const AttachmentPoint& point) {
    return mechanics::positionOf(point, model.dimension, model.restPositions);
  };
  const double restLength =
      entry.contains("rest_length") ? entry["rest_length"].get<double>() : (place(to.point) - place(from.point)).norm();
  model.energies.push_back(mechanics::makeLocalSpring(
      model.dimension, from.point, to.point, restLength, {entry["coefficients"].get<std::vector<double>>()}));
  mechanics::DisplayPart& part = model.parts.front();
  part.springs.push_back({from.point, to.point});
  for (const SpringEnd& end : {from, to})
    if (end.nearestOfLink) part.arms.push_back({*end.nearestOfLink, end.point});
}

void addTorsionSpring(const MechanismContext& context, const Json& entry, const std::string& pointer) {
  context.model.energies.push_back(mechanics::makeTorsionSpring(
      context.model.restPositions, nodeOf(context, entry, "from", pointer), nodeOf(context, entry, "joint", pointer),
      nodeOf(context, entry, "to", pointer), entry["stiffness"]));
}

void addServo(const MechanismContext& context, const Json& entry, const std::string& pointer,
              const mechanics::PeriodicSignal& angle) {
  mechanics::Model& model = context.model;
  const int from = nodeOf(context, entry, "from", pointer), joint = nodeOf(context, entry, "joint", pointer);
  const int to = nodeOf(context, entry, "to", pointer);
  const auto distance = [&](int node) {
    return (model.restPositions.segment(node * model.dimension, model.dimension) -
            model.restPositions.segment(joint * model.dimension, model.dimension))
        .norm();
  };
  const double lever = distance(to);
  if (!(lever > 0)) throw InputError(pointer + "/to", "This node must not be at the servo's joint.");
  const bool hasAxis = entry.contains("axis_end");
  if (hasAxis != (model.dimension == 3))
    throw InputError(pointer + "/axis_end", hasAxis ? "In 2 dimensions a servo's axis is z."
                                                    : "In 3 dimensions a servo needs the other end of its axis.");
  const int scalar = model.addScalars(1);
  model.energies.push_back(
      hasAxis ? mechanics::makeAxisServo(model.restPositions, from, joint, nodeOf(context, entry, "axis_end", pointer),
                                         to, entry["stiffness"], scalar, lever)
              : mechanics::makeServo(model.restPositions, from, joint, to, entry["stiffness"], scalar, lever));
  model.drives.push_back(mechanics::makeScalarDrive(scalar, lever, angle));
}

}  // namespace pliant::scene
