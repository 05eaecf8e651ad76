#include "core/scene/interlock_specs.hpp"

#include "core/scene/composed_cell_specs.hpp"
#include "core/scene/element_design_specs.hpp"
#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

ParameterSpec lengthKey(std::string key, std::string symbol, std::string description, const char* value) {
  return withDefault(
      positive(number(std::move(key), std::move(symbol), std::move(description), dimensions::length)), value);
}

ParameterSpec angleKey(std::string key, std::string description, const char* value) {
  return withDefault(number(std::move(key), "", std::move(description), dimensions::angle), value);
}

ParameterSpec ringRadius(const char* value) {
  return lengthKey("ring_radius", "R", "From a ring's centre to the middle of its wire.", value);
}
ParameterSpec wireRadius(const char* value) {
  return lengthKey("wire_radius", "r", "Half the thickness of the wire.", value);
}
ParameterSpec aspect() {
  return withDefault(
      within(
          number("aspect", "",
                 "Thickness of a ring's wire along the ring's axis, over that in the ring's plane: other than 1, its "
                 "cross-section is an ellipse, within 2 % of its smaller half axis.",
                 dimensions::none),
          1.0 / 3, 3),
      1);
}
ParameterSpec spacing(const char* value) {
  return lengthKey("spacing", "L", "Distance of neighbouring elements at rest.", value);
}

/// A material: its own keys between its name and its supercell.
ParameterSpec cell(std::string type, std::string description, std::vector<ParameterSpec> keys) {
  keys.insert(keys.begin(), name());
  keys.push_back(withDefault(
      list("supercell",
           "So many cells along each lattice vector count as one, whose elements may then move differently: "
           "compression limits depend on it.",
           integer("", "", "Cells.", 1, 16), 2, 2),
      {1, 1}));
  return object(std::move(type), std::move(description), std::move(keys));
}

std::vector<ParameterSpec> rosetteKeys(const char* ring, const char* wire, const char* distance, const char* lean,
                                       const char* apart) {
  return {ringRadius(ring),
          wireRadius(wire),
          lengthKey("distance", "", "Of the rings' centres from the element's.", distance),
          angleKey("lean", "By which each ring is turned out of the plane about its radius.", lean),
          spacing(apart),
          aspect()};
}

ParameterSpec cellReference() {
  return optional(reference("cell", "The material; may be left out if there is one.", "interlocking_cells"));
}

std::vector<ParameterSpec> contactKeys() {
  return {withDefault(positive(within(number("final_gap", "",
                                             "Mean gap that is left where elements hold each other, over the smallest "
                                             "wire radius.",
                                             dimensions::none),
                                      1e-9, 0.1)),
                      1e-4),
          withDefault(
              within(number("perturbation", "",
                            "Elements are moved at random by about this times the wire radius before they are pulled, "
                            "which breaks the symmetries that would hold them near a saddle.",
                            dimensions::none),
                     0, 1),
              0.01),
          withDefault(integer("seed", "", "Of the random numbers.", 0, 1'000'000'000), 1)};
}

ParameterSpec studyOf(std::string type, std::string description, std::vector<ParameterSpec> own) {
  std::vector<ParameterSpec> keys{name(), cellReference()};
  keys.insert(keys.end(), own.begin(), own.end());
  for (ParameterSpec& key : contactKeys()) keys.push_back(std::move(key));
  return object(std::move(type), std::move(description), std::move(keys));
}

ParameterSpec lateralKey() {
  return withDefault(
      choice(
          "lateral",
          "Across the direction the material is \"free\" to stretch and shear, may stretch while the direction stays "
          "a \"principal\" one, is \"held\", or stretches in proportion (\"biaxial\").",
          {"free", "principal", "held", "biaxial"}),
      "free");
}

ParameterSpec ratioKey() {
  return withDefault(
      within(number("ratio", "", "Of the strain across to that along, of a biaxial test.", dimensions::none), -10, 10),
      1);
}

ParameterSpec trialsKey() {
  return withDefault(integer("trials", "",
                             "Tries with seeds that follow one another, of which the farthest counts: for compression, "
                             "where there are many ways to fold.",
                             1, 1000),
                     1);
}

}  // namespace

ParameterSpec frictionKey() {
  return withDefault(
      within(number("friction", "μ",
                    "Coulomb's coefficient of all contacts; 0: none. With friction elements rest where it holds them, "
                    "which depends on the way there, and limits are those of a slow pull from rest.",
                    dimensions::none),
             0, 10),
      0);
}

std::vector<ParameterSpec> interlockingCellSpecs() {
  std::vector<ParameterSpec> scaleKeys =
      rosetteKeys("3.567567567567567 mm", "0.9 mm", "4.6378378378378375 mm", "60 deg", "13.2 mm");
  for (ParameterSpec& key : std::vector<ParameterSpec>{
           lengthKey("plate_height", "", "Of the plate's middle above that of the rings.", "5.289604143230969 mm"),
           lengthKey("plate_inradius", "", "From the middle of the hexagon to its sides, before rounding.", "5.5 mm"),
           lengthKey("plate_radius", "", "Half the plate's thickness, and the radius of its rounding.", "0.8 mm"),
           lengthKey("hub_radius", "", "Of the rod that carries the plate.", "1.2 mm")})
    scaleKeys.push_back(std::move(key));
  return {
      cell("four_in_one", "European 4-in-1 chain mail: staggered rings, each linked with four neighbours.",
           {ringRadius("5 mm"), wireRadius("0.8 mm"), lengthKey("width", "", "Of the cell of two rings.", "12.2 mm"),
            lengthKey("height", "", "Of the cell of two rings.", "7.5 mm"),
            angleKey("tilt", "By which the rings are turned about x, one row down and the next up.", "28 deg"),
            aspect()}),
      cell("threefold", "Three fused rings around a centre, linked with six neighbours on a hexagonal lattice.",
           rosetteKeys("4.8 mm", "1 mm", "5.3 mm", "50 deg", "14.5 mm")),
      cell("square_rosette", "Four fused rings around a centre, linked with four neighbours on a square lattice.",
           rosetteKeys("3.85 mm", "1 mm", "5.005 mm", "45 deg", "13.86 mm")),
      cell("torus_knot",
           "Closed wires ((A + B cos qt) cos pt, (A + B cos qt) sin pt, C sin qt), linked with four neighbours on a "
           "square lattice.",
           {withDefault(integer("p", "p", "Turns about the axis.", 1, 20), 3),
            withDefault(integer("q", "q", "Turns about the ring's core.", 1, 20), 4),
            lengthKey("a", "A", "Radius of the core.", "4.4 mm"), lengthKey("b", "B", "Half width.", "2.2 mm"),
            lengthKey("c", "C", "Half height.", "3.52 mm"), wireRadius("0.6 mm"), spacing("11 mm")}),
      cell("scale_mail",
           "Six rings around a hub that carries a hexagonal plate, linked with six neighbours on a hexagonal lattice.",
           std::move(scaleKeys)),
      cell("ring_net", "Flat rings on a square lattice, joined by upright ones.",
           {ringRadius("4 mm"), wireRadius("0.6 mm"), spacing("12 mm"), aspect()}),
      cell("composed",
           "Any material: elements of shapes made of closed curves, points, segments, triangles and meshes read from "
           "files, on a lattice, with the links that they are meant to have.",
           composedCellKeys())};
}

std::vector<ParameterSpec> interlockStudySpecs() {
  ParameterSpec checkpoint = text(
      "checkpoint",
      "A file, relative to the scene, that keeps every limit as soon as it is found: a run that was stopped goes on "
      "from it.");
  checkpoint.kind = base::ValueKind::path;
  std::vector<ParameterSpec> designKeys = elementDesignKeys();
  for (ParameterSpec& key : std::vector<ParameterSpec>{lateralKey(), ratioKey(), trialsKey()})
    designKeys.push_back(std::move(key));
  return {
      studyOf("cell_test", "How far a material can be stretched or compressed in one direction (thesis 4.3.2).",
              {withDefault(choice("load", "What is done to it.", {"stretch", "compress"}), "stretch"),
               angleKey("direction", "From the first axis.", "0 deg"), lateralKey(), ratioKey(), trialsKey(),
               frictionKey()}),
      studyOf("free_travel",
              "Stretch and compression limits in many directions, and the free travel between them (thesis 4.4.1).",
              {withDefault(integer("directions", "", "Directions, evenly spread over half a turn.", 1, 3600), 36),
               lateralKey(), ratioKey(), trialsKey(), frictionKey()}),
      studyOf("stretch_grid",
              "The same set as of a \"stretch_boundary\", by slices as in the thesis (4.3.3): principal directions, "
              "principal strains between their limits, and the limits across. It asks for no star shape, and makes no "
              "closed surface.",
              {withDefault(integer("directions", "", "Principal directions, over half a turn.", 1, 3600), 36),
               withDefault(integer("steps", "", "Principal strains of each.", 1, 1000), 20)}),
      studyOf(
          "stretch_boundary",
          "The set of all in-plane deformations that a material can reach, as a closed surface (thesis 4.3.3).",
          {withDefault(integer("subdivisions", "",
                               "Of the icosahedron whose corners give the rays: 0 to 5 make 12, 42, 162, 642, "
                               "2562 or 10242 of them.",
                               0, 5),
                       3),
           withDefault(within(number("tolerance", "",
                                     "Edges are cut where the surface is estimated to be farther off than this, "
                                     "over the mean distance from its middle; 0: none.",
                                     dimensions::none),
                              0, 1),
                       0),
           withDefault(integer("maximum_states", "", "Limits that are computed at most.", 12, 1'000'000), 20'000),
           withDefault(boolean("test_star_shape",
                               "Whether each limit is tried with its farthest neighbour's way to fold as well."),
                       true),
           withDefault(boolean("use_symmetries",
                               "Whether limits that symmetries of the cell make the same are computed once; some are "
                               "computed all the same, to check it."),
                       true),
           optional(checkpoint)}),
      studyOf("element_design",
              "Looks for numbers of a material whose limits are those wanted, or as near to them as can be.",
              std::move(designKeys))};
}

}  // namespace pliant::scene
