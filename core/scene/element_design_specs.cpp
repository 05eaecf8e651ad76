#include "core/scene/element_design_specs.hpp"

#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

ParameterSpec goalWeight() {
  return withDefault(
      notNegative(number("weight", "", "Of the squared difference to each wanted limit.", dimensions::none)), 1);
}

ParameterSpec strainTriple(std::string key, std::string description) {
  return list(std::move(key), std::move(description), number("", "", "A strain.", dimensions::none), 3, 3);
}

/// A region of strain space, with keys that all kinds of it have.
ParameterSpec region(std::string type, std::string description, std::vector<ParameterSpec> keys) {
  keys.push_back(withDefault(choice("wanted",
                                    "Whether the material's limits are to be the \"boundary\" of the region, or only "
                                    "everything \"inside\" it is to be reached.",
                                    {"boundary", "inside"}),
                             "boundary"));
  keys.push_back(withDefault(integer("subdivisions", "",
                                     "Of the icosahedron whose corners give the rays from rest along which limits are "
                                     "compared: 0 to 3 make 12, 42, 162 or 642 of them.",
                                     0, 3),
                             0));
  keys.push_back(goalWeight());
  return object(std::move(type), std::move(description), std::move(keys));
}

}  // namespace

std::vector<ParameterSpec> elementDesignKeys() {
  ParameterSpec polarFile =
      optional(text("polar_file",
                    "More of them: a table with the columns \"direction [rad]\", \"stretch\" and \"compression\", as "
                    "free_travel.csv has them; an empty cell wants nothing."));
  polarFile.kind = base::ValueKind::path;
  ParameterSpec surfaceFile = text("file", "A boundary.ply, whose coordinates are Green strain.");
  surfaceFile.kind = base::ValueKind::path;
  return {
      list("parameters", "Numbers of the material that may change; all others stay.",
           object(
               "parameter", "One of them.",
               {text("name",
                     "Its key, such as \"ring_radius\"; deeper in a composed material the way there, such as "
                     "\"shapes/0/pieces/1/radius\"."),
                optional(number("minimum", "", "Smallest value, in SI; half the value if left out.", dimensions::none)),
                optional(
                    number("maximum", "", "Largest value, in SI; twice the value if left out.", dimensions::none))}),
           1, 100),
      optional(list(
          "polar_limits", "Wanted limits of single directions.",
          object("polar_limit", "One direction.",
                 {number("direction", "", "From the first axis.", dimensions::angle),
                  optional(number("stretch", "", "Wanted strain at the stretch limit.", dimensions::none)),
                  optional(within(
                      number("compression", "", "Wanted strain at the compression limit, below 0.", dimensions::none),
                      -1, 0)),
                  goalWeight()}),
          1, 3600)),
      polarFile,
      optional(variant("strain_region",
                       "A region of strain space around rest, in Green strain E_x, E_y, E_xy, that limits are wanted "
                       "for.",
                       {region("box", "Between two corners.",
                               {strainTriple("minimum", "The lower corner, below 0."),
                                strainTriple("maximum", "The upper corner, above 0.")}),
                        region("ellipsoid", "Around a centre.",
                               {withDefault(strainTriple("centre", "Its centre."), Json({0, 0, 0})),
                                strainTriple("half_axes", "Along E_x, E_y and E_xy, above 0.")}),
                        region("surface", "What a boundary of limits encloses.", {surfaceFile})})),
      withDefault(
          notNegative(number("clearance", "c", "Smallest gap at rest, such as a printer needs to keep elements apart.",
                             dimensions::length)),
          0),
      withDefault(integer("iterations", "", "Of the optimiser.", 0, 10'000), 40),
      withDefault(positive(number("tolerance", "",
                                  "Root mean square difference of limits, in strain, at which the element counts as "
                                  "found.",
                                  dimensions::none)),
                  1e-4),
      withDefault(
          positive(within(number("first_step", "", "Largest change of a number in the first iteration, over its range.",
                                 dimensions::none),
                          1e-4, 1)),
          0.2)};
}

}  // namespace pliant::scene
