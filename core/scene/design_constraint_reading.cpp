#include "core/scene/design_constraint_reading.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;
using harmonic::DesignConstraint;
using mechanics::Model;
using mechanics::Vector;

namespace {

int nodeOfProbe(const Model& model, const std::string& name) {
  return std::find_if(model.probes.begin(), model.probes.end(),
                      [&](const mechanics::Probe& probe) { return probe.name == name; })
      ->node;
}

Vector vectorOf(const Json& list) {
  const auto values = list.get<std::vector<double>>();
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

DesignConstraint massConstraint(const Json& entry, const std::string& place) {
  DesignConstraint constraint{"total mass", harmonic::makeTotalMass()};
  if (entry.contains("equal")) {
    if (entry.contains("at_most") || entry.contains("at_least"))
      throw InputError(place + "/equal", "A mass that is given leaves nothing for other bounds.");
    constraint.lower = constraint.upper = entry["equal"];
  } else if (!entry.contains("at_most") && !entry.contains("at_least")) {
    throw InputError(place, "Expected \"at_most\", \"at_least\" or \"equal\".");
  }
  if (entry.contains("at_most")) constraint.upper = entry["at_most"];
  if (entry.contains("at_least")) constraint.lower = entry["at_least"];
  if (constraint.lower > constraint.upper)
    throw InputError(place + "/at_least", "The smallest mass is above the largest one.");
  constraint.scale = entry.contains("at_most") ? constraint.upper : constraint.lower;
  return constraint;
}

DesignConstraint strainConstraint(const Model& model, const Json& entry, const std::string& place) {
  harmonic::StrainGoal goal;
  const Json names = entry.value("geometries", Json::array());
  for (const mechanics::DisplayPart& part : model.parts) {
    if (!names.empty() && std::find(names.begin(), names.end(), part.name) == names.end()) continue;
    // Triangles of a solid are its surface, drawn alone.
    if (part.tetrahedra.empty() && model.dimension > 1)
      goal.triangles.insert(goal.triangles.end(), part.triangles.begin(), part.triangles.end());
    goal.tetrahedra.insert(goal.tetrahedra.end(), part.tetrahedra.begin(), part.tetrahedra.end());
  }
  if (goal.triangles.empty() && goal.tetrahedra.empty())
    throw InputError(place, "There are no triangles or tetrahedra that could be strained.");
  const double most = entry["at_most"];
  goal.sharpness = entry["sharpness"].get<double>() / most;
  DesignConstraint constraint{"strain", harmonic::makeLargestStrain(std::move(goal))};
  constraint.upper = constraint.scale = most;
  return constraint;
}

DesignConstraint clearanceConstraint(const Model& model, const Json& entry, const std::string& place) {
  harmonic::ClearanceGoal goal;
  std::string names;
  for (const Json& probe : entry["probes"]) {
    goal.nodes.push_back(nodeOfProbe(model, probe));
    names += (names.empty() ? "" : " and ") + probe.get<std::string>();
  }
  if (entry.contains("plane")) {
    goal.from = harmonic::Plane{vectorOf(entry["plane"]["point"]), vectorOf(entry["plane"]["normal"])};
    if (vectorOf(entry["plane"]["normal"]).isZero(0))
      throw InputError(place + "/plane/normal", "A normal must have a direction.");
  } else if (entry.contains("sphere")) {
    goal.from = harmonic::Sphere{vectorOf(entry["sphere"]["centre"]), entry["sphere"]["radius"]};
  } else {
    const int other = nodeOfProbe(model, entry["node"]["probe"]);
    if (std::find(goal.nodes.begin(), goal.nodes.end(), other) != goal.nodes.end())
      throw InputError(place + "/node/probe", "A node has no distance from itself.");
    goal.from = harmonic::OtherNode{other};
  }
  const double resolution = entry["resolution"], least = entry["at_least"];
  goal.sharpness = 1 / resolution;
  DesignConstraint constraint{"clearance of " + names, harmonic::makeClearance(std::move(goal))};
  constraint.lower = least;
  constraint.scale = std::max(std::abs(least), 10 * resolution);
  return constraint;
}

}  // namespace

std::vector<DesignConstraint> readDesignConstraints(const Model& model, const Json& constraints,
                                                    const std::string& place) {
  std::vector<DesignConstraint> list;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const Json& entry = constraints[i];
    const std::string here = childPointer(place, i);
    if (entry["type"] == "total_mass")
      list.push_back(massConstraint(entry, here));
    else if (entry["type"] == "strain")
      list.push_back(strainConstraint(model, entry, here));
    else
      list.push_back(clearanceConstraint(model, entry, here));
  }
  return list;
}

}  // namespace pliant::scene
