#include "core/scene/macro_specs.hpp"

#include "core/scene/cloth_specs.hpp"
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

ParameterSpec polygon(std::string key, std::string description, bool mayBeLeftOut) {
  ParameterSpec spec = list(std::move(key), std::move(description),
                            list("", "A corner.", number("", "", "Coordinate.", dimensions::length), 2, 2), 3, 100'000);
  return mayBeLeftOut ? optional(spec) : spec;
}

ParameterSpec three(std::string key, std::string description, base::Dimension dimension) {
  return list(std::move(key), std::move(description), number("", "", "Component.", dimension), 3, 3);
}

std::vector<ParameterSpec> outlineKeys() {
  return {
      withDefault(choice("shape",
                         "Of the sheet: a \"hexagon\" with corners on the x axis, a \"disk\", a \"rectangle\", an "
                         "\"outline\" that is meshed irregularly, or a flat \"mesh\" from a file; the middle of these "
                         "two is where their coordinates say.",
                         {"hexagon", "disk", "rectangle", "outline", "mesh"}),
                  "disk"),
      optional(positive(number("radius", "", "Of a disk, or of a hexagon to its corners.", dimensions::length))),
      optional(list("size", "Sides of a rectangle.", positive(number("", "", "Length.", dimensions::length)), 2, 2)),
      limitFile("mesh", "A triangle mesh in the plane z = 0, in metres; relative to the scene."),
      polygon("corners", "Of an outline, in order.", true),
      limitFile("outline",
                "A polygon from a CSV file with the columns \"x [mm]\" and \"y [mm]\", and \"loop\" if there are "
                "holes, or from the lines of an OBJ file; relative to the scene."),
      withDefault(list("holes", "In an outline.", polygon("", "Corners in order.", false), 0, 1000), Json::array()),
      withDefault(
          integer("rings", "",
                  "Of triangles, from the middle to the rim; of a rectangle cells along its longer side, of an outline "
                  "triangles along the longer side of its box.",
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

ParameterSpec regions() {
  std::vector<ParameterSpec> keys{
      name(), polygon("corners", "Of a polygon in the sheet's plane: triangles with their middle inside.", true),
      optional(list(
          "triangles", "Numbers of triangles, from 0.", integer("", "", "A triangle.", 0, 10'000'000), 1, 10'000'000)),
      optional(reference("cell", "The material; the sheet's if left out.", "interlocking_cells")),
      withDefault(number("angle", "", "Of the material's first axis in the sheet.", dimensions::angle), "0 deg")};
  for (ParameterSpec& key : materialKeys()) keys.push_back(std::move(key));
  ParameterSpec region = object("region", "Where another material is, or the same turned.", std::move(keys));
  region.exactlyOne = {"corners", "triangles"};
  return withDefault(list("regions", "Parts of the sheet with their own materials; of several for a triangle the last.",
                          std::move(region), 0, 1000),
                     Json::array());
}

/// A disk of nodes.
std::vector<ParameterSpec> nodeKeys() {
  return {place(),
          withDefault(
              notNegative(number("radius", "", "Nodes no farther than this; 0: the nearest.", dimensions::length)), 0)};
}

std::vector<ParameterSpec> loadKeys() {
  return {
      withDefault(list("clamps", "Nodes that do not move.", object("", "A disk of the sheet.", nodeKeys()), 0, 1000),
                  Json::array()),
      withDefault(
          list("loads", "Forces on the node that is nearest.",
               object("", "One force.",
                      {place(), list("force", "Components.", number("", "F", "Component.", dimensions::force), 3, 3)}),
               0, 1000),
          Json::array()),
      withDefault(list("gravity", "Acceleration.", number("", "g", "Component.", dimensions::acceleration), 3, 3),
                  {0, 0, -9.81}),
      withDefault(
          object("placement", "How the sheet lies at the start: turned about its origin, then moved.",
                 {withDefault(three("position", "Of its origin.", dimensions::length), {0, 0, 0}),
                  withDefault(three("axis", "Of the turn; only its direction counts.", dimensions::none), {0, 0, 1}),
                  withDefault(number("angle", "", "Counter-clockwise seen against the axis.", dimensions::angle), 0)}),
          Json::object())};
}

ParameterSpec motionStudy(std::vector<ParameterSpec> keys) {
  std::vector<ParameterSpec> grip = nodeKeys();
  grip.push_back(motionSpec("How they move, turning about their mean position."));
  grip.push_back(
      optional(notNegative(number("release", "", "When they are let go; never if left out.", dimensions::time))));
  const base::Dimension rate{0, 0, -1, 0};
  for (ParameterSpec key : {
           withDefault(list("grips", "Nodes that are moved, as far as limits and bodies let them.",
                            object("", "A disk of the sheet.", std::move(grip)), 0, 1000),
                       Json::array()),
           withDefault(three("velocity", "Of the whole sheet at the start.", base::Dimension{0, 1, -1, 0}), {0, 0, 0}),
           positive(number("duration", "", "Of the motion.", dimensions::time)),
           withDefault(positive(number("time_step", "h", "Of implicit Euler.", dimensions::time)), "10 ms"),
           withDefault(
               notNegative(number("damping", "", "The force -damping · mass · velocity acts on every node.", rate)), 0),
           withDefault(positive(number("barrier", "",
                                       "Coefficient of the limits' barrier, as an energy over the work that the loads "
                                       "could do over the size of the sheet: how softly limits are felt.",
                                       dimensions::none)),
                       1e-2),
           withDefault(integer("frame_every", "", "Steps from one frame that is kept to the next.", 1, 1'000'000), 1),
       })
    keys.push_back(std::move(key));
  return object("macro_motion",
                "The motion of a large piece with inertia, from rest, by implicit Euler: each step is the equilibrium "
                "of its forces within the material's limits and without going through bodies or itself.",
                std::move(keys));
}

}  // namespace

std::vector<ParameterSpec> macroStudySpecs() {
  std::vector<ParameterSpec> keys{
      name(), optional(reference("cell", "The material; may be left out if there is one.", "interlocking_cells"))};
  for (std::vector<ParameterSpec> group : {outlineKeys(), materialKeys(), {regions()}, loadKeys()})
    keys.insert(keys.end(), group.begin(), group.end());
  keys.push_back(withDefault(
      within(number("margin", "",
                    "How far inside their limits strains stay, of the way from the middle of the set to its boundary: "
                    "gauges are below 1 - margin. It leaves room between elements.",
                    dimensions::none),
             0, 0.9),
      0));
  keys.push_back(withDefault(
      boolean("elements",
              "Whether the material's elements are placed on the sheet where it ends, following its way from rest so "
              "that none meets another and every link holds. Regions may have other elements on the same lattice."),
      false));
  ParameterSpec motion = motionStudy(keys);
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
      integer(
          "load_steps", "",
          "Equal steps in which gravity and loads come, each from where the one before ended; of more than one every "
          "step is kept as a frame, and the native patch takes the same steps.",
          1, 1000),
      1));
  keys.push_back(withDefault(
      positive(within(number("final_gap", "", "Of the native patch: mean gap that is left, over the wire radius.",
                             dimensions::none),
                      1e-9, 0.1)),
      5e-4));
  return {
      object("macro_equilibrium",
             "A large piece at rest under loads, as a sheet whose strains stay within the material's limits (thesis "
             "4.3.4).",
             std::move(keys)),
      std::move(motion)};
}

}  // namespace pliant::scene
