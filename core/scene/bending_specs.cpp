#include "core/scene/bending_specs.hpp"

#include "core/scene/interlock_specs.hpp"
#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

ParameterSpec patchLength(std::string key, std::string description) {
  return positive(number(std::move(key), "", std::move(description), dimensions::length));
}

/// Keys of all studies of patches; the outline's only where there is a single patch.
ParameterSpec patchStudy(std::string type, std::string description, std::vector<ParameterSpec> own, bool onePatch,
                         double gap) {
  std::vector<ParameterSpec> keys{
      name(), optional(reference("cell", "The material; may be left out if there is one.", "interlocking_cells"))};
  if (onePatch) {
    keys.push_back(optional(patchLength(
        "radius", "Of a circle: elements belong to the patch if their origins at rest lie inside. This or \"size\".")));
    keys.push_back(optional(list("size", "Sides of a rectangle in the same way.", patchLength("", "Length."), 2, 2)));
  }
  keys.push_back(withDefault(list("centre", "Of the outline, from the origin of the cell.",
                                  number("", "", "Coordinate.", dimensions::length), 2, 2),
                             {0, 0}));
  keys.insert(keys.end(), own.begin(), own.end());
  keys.push_back(withDefault(positive(within(number("final_gap", "",
                                                    "Mean gap that is left where elements hold each other, over the "
                                                    "smallest wire radius.",
                                                    dimensions::none),
                                             1e-9, 0.1)),
                             gap));
  keys.push_back(withDefault(
      within(number("perturbation", "", "Elements are moved at random by about this times the wire radius first.",
                    dimensions::none),
             0, 1),
      0.3));
  keys.push_back(withDefault(integer("seed", "", "Of the random numbers.", 0, 1'000'000'000), 1));
  return object(std::move(type), std::move(description), std::move(keys));
}

ParameterSpec incrementKey() {
  return withDefault(
      within(number("increment", "",
                    "The curvature grows by as much at a time as would lift the outermost element by this many wire "
                    "radii, and elements are centred in between; 0: pulled at once.",
                    dimensions::none),
             0, 1000),
      4);
}

ParameterSpec bendingTrials() {
  return withDefault(integer("trials", "",
                             "Tries with seeds that follow one another, of which the farthest counts: a patch may bend "
                             "in ways that lock earlier and later.",
                             1, 1000),
                     3);
}

ParameterSpec lateralChoice() {
  return withDefault(
      choice("lateral",
             "The curvature across the direction is free while the direction stays a \"principal\" one, \"free\" with "
             "twist as well, or \"held\" at 0.",
             {"principal", "free", "held"}),
      "principal");
}

ParameterSpec directionKey() {
  return withDefault(
      number("direction", "", "Of the principal curvature, from the first axis.", dimensions::angle), "0 deg");
}

}  // namespace

std::vector<ParameterSpec> bendingStudySpecs() {
  ParameterSpec checkpoint =
      text("checkpoint", "A file, relative to the scene, that keeps every limit as soon as it is found.");
  checkpoint.kind = base::ValueKind::path;
  const ParameterSpec directions =
      withDefault(integer("directions", "", "Directions, evenly spread over half a turn.", 1, 360), 12);
  return {
      patchStudy(
          "bending_test", "The largest curvature of a finite patch, whose elements lie on a paraboloid (thesis 4.3.2).",
          {directionKey(),
           withDefault(
               choice("bend", "Up: the rim rises above the middle; the curvature is positive.", {"up", "down"}), "up"),
           lateralChoice(), incrementKey(), bendingTrials()},
          true, 1e-3),
      patchStudy("curvature_limits",
                 "The same in many directions, up and down, with the curvature across (thesis Fig. 4.6).",
                 {directions, lateralChoice(), incrementKey(), bendingTrials()}, true, 1e-3),
      patchStudy("bending_size",
                 "Limits of single and double curvature of circular patches of several sizes (thesis Fig. 4.8).",
                 {list("radii", "Radii of the patches.", patchLength("", "Radius."), 1, 20), directionKey(),
                  incrementKey(), bendingTrials()},
                 false, 1e-3),
      patchStudy(
          "bending_boundary", "The set of all curvatures that a patch can reach, as a closed surface (thesis 4.3.3).",
          {withDefault(integer("subdivisions", "",
                               "Of the icosahedron whose corners give the rays: 0 to 4 make 12, 42, 162, 642 "
                               "or 2562 of them.",
                               0, 4),
                       2),
           withDefault(
               boolean("test_star_shape", "Whether each limit is tried with its farthest neighbour's state as well."),
               true),
           incrementKey(), bendingTrials(), optional(checkpoint)},
          true, 1e-3),
      patchStudy(
          "gravity_bending", "How a patch that is clamped at one side bends under its weight (thesis Fig. 4.12).",
          {withDefault(number("direction", "", "From the clamped side to the free one, from the first axis.",
                              dimensions::angle),
                       "0 deg"),
           withDefault(notNegative(number("clamped_width", "",
                                          "Elements no farther than this from the first ones in that direction "
                                          "are clamped.",
                                          dimensions::length)),
                       "1 mm"),
           withDefault(list("gravity", "Acceleration.", number("", "g", "Component.", dimensions::acceleration), 3, 3),
                       {0, 0, -9.81}),
           withDefault(positive(number("density", "ρ", "Of the elements.", dimensions::density)), 1180), frictionKey()},
          true, 1e-4)};
}

}  // namespace pliant::scene
