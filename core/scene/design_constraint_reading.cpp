#include "core/scene/design_constraint_reading.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/harmonic/stress_quantity.hpp"
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

/// What of an entry's geometries is deformed.
struct ChosenElements {
  mechanics::Triangles triangles;
  mechanics::Tetrahedra tetrahedra;
};

ChosenElements elementsOf(const Model& model, const Json& entry, const std::string& place) {
  ChosenElements chosen;
  const Json names = entry.value("geometries", Json::array());
  for (const mechanics::DisplayPart& part : model.parts) {
    if (!names.empty() && std::find(names.begin(), names.end(), part.name) == names.end()) continue;
    // Triangles of a solid are its surface, drawn alone.
    if (part.tetrahedra.empty() && model.dimension > 1)
      chosen.triangles.insert(chosen.triangles.end(), part.triangles.begin(), part.triangles.end());
    chosen.tetrahedra.insert(chosen.tetrahedra.end(), part.tetrahedra.begin(), part.tetrahedra.end());
  }
  if (chosen.triangles.empty() && chosen.tetrahedra.empty())
    throw InputError(place, "There are no triangles or tetrahedra that could be strained.");
  return chosen;
}

/// Of stress, or of the strain of surfaces, within `most`.
DesignConstraint stressConstraint(const Scene& scene, const Model& model, const Json& entry, const std::string& place,
                                  mechanics::ElementMeasure measure) {
  const ChosenElements chosen = elementsOf(model, entry, place);
  const Json names = entry.value("geometries", Json::array());
  for (const Json& element : scene.normalized()["elements"])
    if ((element["type"] == "rod" || element["type"] == "flat_rod") &&
        (names.empty() || std::find(names.begin(), names.end(), element["geometry"]) != names.end()))
      throw InputError(place, "The stress of rods such as " + quote(element["name"].get<std::string>()) +
                                  " is not known: name the \"geometries\" of sheets and solids.");
  if (mechanics::ElementStress(model, chosen.triangles, chosen.tetrahedra, measure).count() == 0)
    throw InputError(place, "There are no membranes, shells or solids that could be stressed.");
  const double most = entry["at_most"], sharpness = entry["sharpness"];
  const bool isStress = measure == mechanics::ElementMeasure::vonMises;
  DesignConstraint constraint{
      isStress ? "stress" : "strain of surfaces",
      harmonic::makeLargestStress({chosen.triangles, chosen.tetrahedra, measure, sharpness / most})};
  constraint.upper = constraint.scale = most;
  return constraint;
}

DesignConstraint strainConstraint(const Scene& scene, const Model& model, const Json& entry, const std::string& place) {
  if (entry["surfaces"])
    return stressConstraint(scene, model, entry, place, mechanics::ElementMeasure::principalStrain);
  ChosenElements chosen = elementsOf(model, entry, place);
  const double most = entry["at_most"], sharpness = entry["sharpness"];
  DesignConstraint constraint{"strain", harmonic::makeLargestStrain({std::move(chosen.triangles),
                                                                     std::move(chosen.tetrahedra), sharpness / most})};
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

std::vector<DesignConstraint> readDesignConstraints(const Scene& scene, const Model& model, const Json& constraints,
                                                    const std::string& place) {
  std::vector<DesignConstraint> list;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const Json& entry = constraints[i];
    const std::string here = childPointer(place, i);
    if (entry["type"] == "total_mass")
      list.push_back(massConstraint(entry, here));
    else if (entry["type"] == "strain")
      list.push_back(strainConstraint(scene, model, entry, here));
    else if (entry["type"] == "stress")
      list.push_back(stressConstraint(scene, model, entry, here, mechanics::ElementMeasure::vonMises));
    else
      list.push_back(clearanceConstraint(model, entry, here));
  }
  return list;
}

}  // namespace pliant::scene
