#include "core/scene/macro_specs.hpp"

#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

ParameterSpec limitFile(std::string key, std::string description) {
  ParameterSpec spec = text(std::move(key), std::move(description));
  spec.kind = base::ValueKind::path;
  return optional(std::move(spec));
}

ParameterSpec place() {
  return list(
      "point", "In the sheet's plane, from its middle.", number("", "", "Coordinate.", dimensions::length), 2, 2);
}

std::vector<ParameterSpec> outlineKeys() {
  return {
      withDefault(choice("shape",
                         "Of the sheet: a \"hexagon\" with corners on the x axis, a \"disk\", a \"rectangle\", or a "
                         "flat \"mesh\" from a file, whose middle is where its coordinates say.",
                         {"hexagon", "disk", "rectangle", "mesh"}),
                  "disk"),
      optional(positive(number("radius", "", "Of a disk, or of a hexagon to its corners.", dimensions::length))),
      optional(list("size", "Sides of a rectangle.", positive(number("", "", "Length.", dimensions::length)), 2, 2)),
      limitFile("mesh", "A triangle mesh in the plane z = 0, in metres; relative to the scene."),
      withDefault(
          integer("rings", "", "Of triangles, from the middle to the rim; of a rectangle cells along its longer side.",
                  1, 400),
          8),
      withDefault(
          list("centre", "Of the outline, from the origin of the cell: it says which elements a native patch has.",
               number("", "", "Coordinate.", dimensions::length), 2, 2),
          {0, 0}),
      withDefault(number("angle", "", "Of the material's first axis in the sheet.", dimensions::angle), "0 deg")};
}

std::vector<ParameterSpec> materialKeys() {
  return {
      limitFile("stretch_limits",
                "What a \"stretch_boundary\" wrote (boundary.ply), relative to the scene; without it the boundary is "
                "computed, of 642 limits."),
      limitFile("bending_limits",
                "What a \"bending_boundary\" wrote; without it bending has no limit, as of materials that fold."),
      withDefault(positive(number("young_modulus", "Y", "Of the weak elastic base.", dimensions::pressure)), "1250 Pa"),
      withDefault(within(number("poisson_ratio", "ν", "Of the base.", dimensions::none), -0.99, 0.49), 0.4),
      withDefault(
          positive(number("density", "ρ", "Of the sheet: mass over area and thickness.", dimensions::density)), 250),
      optional(positive(
          number("thickness", "", "Of the sheet; without it the height of the elements.", dimensions::length)))};
}

std::vector<ParameterSpec> loadKeys() {
  return {
      withDefault(list("clamps", "Nodes that do not move.",
                       object("", "A disk of the sheet.",
                              {place(), withDefault(notNegative(number("radius", "",
                                                                       "Nodes no farther than this; 0: "
                                                                       "the nearest.",
                                                                       dimensions::length)),
                                                    0)}),
                       0, 1000),
                  Json::array()),
      withDefault(
          list("loads", "Forces on the node that is nearest.",
               object("", "One force.",
                      {place(), list("force", "Components.", number("", "F", "Component.", dimensions::force), 3, 3)}),
               0, 1000),
          Json::array()),
      withDefault(list("gravity", "Acceleration.", number("", "g", "Component.", dimensions::acceleration), 3, 3),
                  {0, 0, -9.81})};
}

}  // namespace

std::vector<ParameterSpec> macroStudySpecs() {
  std::vector<ParameterSpec> keys{
      name(), optional(reference("cell", "The material; may be left out if there is one.", "interlocking_cells"))};
  for (std::vector<ParameterSpec> group : {outlineKeys(), materialKeys(), loadKeys()})
    keys.insert(keys.end(), group.begin(), group.end());
  keys.push_back(withDefault(
      choice("limits", "What keeps the limits: a \"barrier\" that is never violated, or the \"penalty\" of the thesis.",
             {"barrier", "penalty"}),
      "barrier"));
  keys.push_back(
      withDefault(positive(number("penalty", "k",
                                  "Times the cube of the distance from the limit, over the size of the set and an "
                                  "area [J/m²].",
                                  dimensions::none)),
                  1e7));
  keys.push_back(withDefault(
      boolean("native", "Whether the patch of elements is computed as well, under the same loads, to compare."),
      false));
  keys.push_back(withDefault(
      positive(within(number("final_gap", "", "Of the native patch: mean gap that is left, over the wire radius.",
                             dimensions::none),
                      1e-9, 0.1)),
      5e-4));
  return {
      object("macro_equilibrium",
             "A large piece at rest under loads, as a sheet whose strains stay within the material's limits (thesis "
             "4.3.4).",
             std::move(keys))};
}

}  // namespace pliant::scene
