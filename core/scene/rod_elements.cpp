#include "core/scene/rod_elements.hpp"

#include "core/base/error.hpp"
#include "core/mechanics/rod.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

namespace {

using base::InputError;
namespace dimensions = base::dimensions;

base::ParameterSpec sectionLength(std::string key, std::string description) {
  return spec::positive(spec::number(std::move(key), "", std::move(description), dimensions::length));
}

mechanics::RodSection rodSection(const Json& entry) {
  if (entry["type"] == "flat_rod") return mechanics::rectangularSection(entry["width"], entry["height"]);
  const double diameter = entry["diameter"], innerDiameter = entry["inner_diameter"];
  return mechanics::tubularSection(diameter / 2, innerDiameter / 2);
}

}  // namespace

std::vector<base::ParameterSpec> rodSpecs(const base::ParameterSpec& geometry, const base::ParameterSpec& material) {
  return {spec::object(
              "rod",
              "Round wires or tubes along the segments of a geometry (discrete elastic rods), in 3 dimensions; "
              "where three or more segments meet they are joined rigidly.",
              {spec::name(), geometry, material, sectionLength("diameter", "Outer diameter."),
               spec::withDefault(
                   spec::notNegative(spec::number("inner_diameter", "", "0 for a wire.", dimensions::length)), 0)}),
          spec::object("flat_rod", "The same with a rectangular section.",
                       {spec::name(), geometry, material, sectionLength("width", "Size along the director."),
                        sectionLength("height", "Size across the director."),
                        spec::vector("director", "Direction of the width; its part along a segment does not count.",
                                     dimensions::none)})};
}

void addRods(const ElementContext& context) {
  mechanics::Model& model = context.model;
  if (model.dimension != 3) throw InputError(context.pointer, "Rods need a scene of 3 dimensions.");
  const auto pairs = context.geometry.global(context.geometry.segments);
  if (pairs.empty())
    throw InputError(
        context.pointer + "/geometry", "The geometry " + quote(context.geometry.name) + " has no segments.");
  const Json &material = *context.material, &entry = context.entry;
  mechanics::RodSegment like;
  const double young = material["young_modulus"], poisson = material["poisson_ratio"];
  like.material = {.youngModulus = young, .shearModulus = young / (2 * (1 + poisson)), .density = material["density"]};
  like.section = rodSection(entry);
  if (entry.contains("director"))
    for (int axis = 0; axis < 3; ++axis) like.director[axis] = entry["director"][axis];

  std::vector<mechanics::RodSegment> segments;
  std::set<int> nodes, framed;
  for (const auto& pair : pairs) {
    like.nodes = pair;
    segments.push_back(like);
    nodes.insert(pair.begin(), pair.end());
  }
  for (const int node : context.heldNodes)
    if (nodes.contains(node)) framed.insert(node);
  const mechanics::RodNetwork rods(
      model.restPositions, segments, {framed.begin(), framed.end()}, model.coordinateCount());
  for (auto& energy : rods.energies()) model.energies.push_back(std::move(energy));
  rods.addMass(context.massMatrix, context.mass);
  model.addScalars(rods.scalarCount());
  for (const auto& [node, coordinate] : rods.frameCoordinates())
    context.frames.push_back({node, coordinate, rods.frameLength(node)});
  context.part.segments.insert(context.part.segments.end(), pairs.begin(), pairs.end());
}

}  // namespace pliant::scene
