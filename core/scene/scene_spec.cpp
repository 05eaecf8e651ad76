#include "core/scene/cloth_specs.hpp"
#include "core/scene/element_specs.hpp"
#include "core/scene/interlock_specs.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/spec_builder.hpp"
#include "core/scene/study_specs.hpp"

namespace pliant::scene {
namespace {

using namespace spec;
namespace dimensions = base::dimensions;

constexpr int longestList = 10'000;

/// A geometry: its own keys between its name and its placement.
ParameterSpec geometry(std::string type, std::string description, std::vector<ParameterSpec> keys) {
  keys.insert(keys.begin(), name());
  keys.push_back(withDefault(vector("position", "Where the geometry's origin is put.", dimensions::length), {0, 0, 0}));
  keys.push_back(
      optional(object("rotation", "Turns the geometry about its origin before it is put in place.",
                      {withDefault(list("axis", "Axis of rotation; only its direction counts.",
                                        number("", "", "A component.", dimensions::none), 3, 3),
                                   {0, 0, 1}),
                       number("angle", "", "Angle, counter-clockwise seen against the axis.", dimensions::angle)})));
  return object(std::move(type), std::move(description), std::move(keys));
}

ParameterSpec cells(std::string key, std::string description) {
  return integer(std::move(key), "", std::move(description), 1, 1000);
}

ParameterSpec length(std::string key, std::string description) {
  return positive(number(std::move(key), "", std::move(description), dimensions::length));
}

/// Elements of `corners` nodes each.
ParameterSpec tuples(std::string key, std::string description, std::string item, int corners) {
  return withDefault(list(std::move(key), std::move(description),
                          list("", std::move(item), nodeIndex(), corners, corners), 0, 6 * largestMesh),
                     Json::array());
}

ParameterSpec points() {
  return list("points", "Positions of the nodes.", vector("", "A position.", dimensions::length), 1, largestMesh);
}

ParameterSpec geometries() {
  return variant(
      "geometry", "Nodes, and triangles between them.",
      {geometry("points", "Nodes without triangles.", {points()}),
       geometry("fork",
                "A handle along x from the origin that branches into two prongs, in the plane z = 0. Groups: \"base\", "
                "\"left_tip\" (y > 0), \"right_tip\".",
                {length("handle_length", "Length of the handle."), length("prong_length", "Length of each prong."),
                 length("width", "Width of the handle and of each prong."),
                 length("spacing", "Distance between the centre lines of the prongs."),
                 cells("handle_cells", "Cells along the handle."), cells("prong_cells", "Cells along each prong."),
                 cells("width_cells", "Cells across the handle and each prong.")}),
       geometry("strip",
                "A narrow rectangle along x from the origin, centred in y, in the plane z = 0. Groups: \"start\" "
                "(x = 0), \"end\".",
                {length("length", "Size along x."), length("width", "Size along y."),
                 cells("length_cells", "Cells along x."), withDefault(cells("width_cells", "Cells along y."), 1)}),
       geometry("grid",
                "A rectangle along x from the origin, centred in y, in the plane z = 0. Groups: \"start\" (x = 0), "
                "\"end\", \"left\" (largest y), \"right\".",
                {length("length", "Size along x."), length("width", "Size along y."),
                 cells("length_cells", "Cells along x."), cells("width_cells", "Cells along y.")}),
       geometry("mesh", "Nodes with triangles, segments or tetrahedra between them, written in the scene.",
                {points(), tuples("triangles", "Three node indices each, counted from 0.", "A triangle.", 3),
                 tuples("segments", "Two node indices each: edges of rods, or links.", "A segment.", 2),
                 tuples("tetrahedra", "Four node indices each.", "A tetrahedron.", 4),
                 withDefault(list("groups", "Named sets of nodes, to be selected by \"group\".",
                                  object("group", "Nodes with a name.",
                                         {name(), list("nodes", "Indices of nodes, counted from 0.", nodeIndex(), 1,
                                                       largestMesh)}),
                                  0, 1000),
                             Json::array())}),
       geometry(
           "blocks",
           "Boxes of tetrahedra, cut into cells; where they meet or overlap their nodes are one. Groups: the name "
           "of each block and its sides, such as \"foot.y_min\", \"foot.z_max\".",
           {vector("cell", "Size of a cell along x, y and z; boxes are whole numbers of them.", dimensions::length),
            list("blocks", "The boxes.",
                 object("block", "A box.",
                        {name(), vector("minimum", "Its lower corner.", dimensions::length),
                         vector("maximum", "Its upper corner.", dimensions::length)}),
                 1, 1000)}),
       geometry("file", "Triangles read from an STL, OBJ or PLY file.", [] {
         ParameterSpec path = text("path", "The file, relative to the scene.");
         path.kind = base::ValueKind::path;
         return std::vector<ParameterSpec>{
             path, withDefault(positive(number("scale", "", "Metres per unit of the file.", dimensions::none)), 1),
             withDefault(notNegative(number(
                             "weld_tolerance", "", "Points closer than this become one node.", dimensions::length)),
                         "1 um")};
       }())});
}

ParameterSpec coefficients() {
  constexpr int highestPower = 9;
  ParameterSpec spec =
      list("coefficients", "Force = Σ coefficients[i] e^(i+1) of the elongation e: N/m, N/m^2, N/m^3, ...",
           number("", "", "Coefficient of e.", dimensions::stiffness), 1, highestPower);
  for (int i = 1; i < highestPower; ++i)
    spec.items.push_back(number("", "", "Coefficient of e^" + std::to_string(i + 1) + ".", {1, -i, -2, 0}));
  return spec;
}

ParameterSpec torsionStiffness() { return notNegative(number("stiffness", "k", "Moment per angle.", {1, 2, -2, -1})); }

ParameterSpec springEnd(std::string key, std::string description) {
  return variant(
      std::move(key), std::move(description),
      {object(
           "link", "A point of a link.",
           {reference("link", "A link among the elements.", "elements"),
            number("along", "", "From its first joint towards its second.", dimensions::length),
            withDefault(number("across", "", "To the left of that line; 0 in 3 dimensions.", dimensions::length), 0)}),
       object("node", "A node.", {selection("at", "One node.")}),
       object("place", "A fixed place.", {vector("position", "Where.", dimensions::length)})});
}

ParameterSpec springs() {
  const auto restLength = optional(notNegative(number(
      "rest_length", "l", "Length without force; the distance in the rest shape if left out.", dimensions::length)));
  return variant(
      "spring", "A force along a line, a polynomial of the elongation.",
      {object("between", "Between two nodes; elongation = distance - rest_length.",
              {name(), selection("from", "One node."), selection("to", "Another node."), restLength, coefficients()}),
       object("anchored", "Between a node and a fixed place; elongation = distance - rest_length.",
              {name(), selection("at", "One node."), vector("anchor", "The fixed place.", dimensions::length),
               restLength, coefficients()}),
       object("local", "Between two points that move with links; elongation = distance - rest_length.",
              {name(), springEnd("from", "One end."), springEnd("to", "The other end."), restLength, coefficients()}),
       object("torsion",
              "A moment about a joint, proportional to the change of the angle between two links, in 2 dimensions.",
              {name(), selection("joint", "One node."), selection("from", "Another node of one link."),
               selection("to", "Another node of the other link."), torsionStiffness()}),
       object("grounded", "Pulls a node back along a direction; elongation = displacement along it.",
              {name(), selection("at", "Nodes; each gets its own spring."),
               vector("direction", "Only the direction counts.", dimensions::none), coefficients()})});
}

ParameterSpec pointMasses() {
  return object("point_mass", "A mass on each of some nodes; a design parameter.",
                {name(), selection("at", "Nodes; each gets the mass."),
                 optional(object("mirrored",
                                 "The nodes that rest nearest to their mirror images in this plane get the mass as "
                                 "well: a symmetric pair is one parameter.",
                                 {vector("point", "Any point of it.", dimensions::length),
                                  vector("normal", "Only its direction counts.", dimensions::none)})),
                 notNegative(number("mass", "m", "Mass.", dimensions::mass)),
                 withDefault(notNegative(number("minimum", "", "Smallest mass in design.", dimensions::mass)), 0),
                 optional(notNegative(number(
                     "maximum", "", "Largest mass in design; 5 times the mass if left out.", dimensions::mass)))});
}

ParameterSpec boundaryConditions() {
  ParameterSpec spec = variant(
      "boundary_condition", "What some nodes may not do.",
      {object("locked", "Coordinates that keep their rest value. Where all are locked, rods are clamped as well.",
              {name(), selection("at", "Nodes."),
               optional(list("coordinates", "Which; all if left out. If given, rods may still turn.",
                             choice("", "A coordinate.", {"x", "y", "z"}), 1, 3))}),
       pinSpec()});
  spec.defaultItem = "locked";
  return spec;
}

ParameterSpec drives() {
  return variant(
      "drive", "Prescribes the periodic motion of nodes exactly.",
      {object("translation", "Moves nodes along a line; rods that meet there keep their direction.",
              {name(), selection("at", "Nodes."), vector("direction", "Only the direction counts.", dimensions::none),
               signal("Displacement over time.", dimensions::length)}),
       object("rotation", "Turns nodes about an axis, and with them the rods that meet there.",
              {name(), selection("at", "Nodes."),
               withDefault(vector("center", "A place on the axis.", dimensions::length), {0, 0, 0}),
               withDefault(list("axis", "Direction of the axis; in 2 dimensions it is z.",
                                number("", "", "A component.", dimensions::none), 3, 3),
                           {0, 0, 1}),
               signal("Angle over time.", dimensions::angle)}),
       object(
           "servo",
           "Turns a link against another one that may itself move, by a stiff torsion spring whose rest angle is "
           "prescribed.",
           {name(), selection("joint", "One node, at the joint."),
            selection("from", "Another node of the link that carries the servo."),
            selection("to", "Another node of the link that it turns."),
            optional(selection("axis_end", "In 3 dimensions: a second node on the axis, which both links share.")),
            withDefault(torsionStiffness(), 1e4), signal("Angle over time, counter-clockwise.", dimensions::angle)})});
}

ParameterSpec loads() {
  return variant("load", "External forces.",
                 {object("gravity", "Acts on all mass.",
                         {name(), vector("acceleration", "Such as [0, 0, -9.81].", dimensions::acceleration)}),
                  windSpec(),
                  object("harmonic_force", "A periodic force on each of some nodes.",
                         {name(), selection("at", "Nodes; each gets the force."),
                          vector("direction", "Only the direction counts.", dimensions::none),
                          signal("Force over time.", dimensions::force)})});
}

ParameterSpec expectedValues() {
  ParameterSpec spec =
      object("expected_value", "What a study must give; running a scene checks it.",
             {reference("study", "Name of the study.", "studies"),
              text("pointer", "JSON pointer into the study's summary.json."),
              number("value", "", "Expected number, in SI.", dimensions::none),
              optional(notNegative(number("tolerance", "", "Largest difference, in SI.", dimensions::none))),
              optional(notNegative(number(
                  "relative_tolerance", "", "Largest difference as a fraction of the value.", dimensions::none)))});
  spec.exactlyOne = {"tolerance", "relative_tolerance"};
  return spec;
}

ParameterSpec entries(std::string key, std::string description, ParameterSpec item) {
  return withDefault(list(std::move(key), std::move(description), std::move(item), 0, longestList), Json::array());
}

ParameterSpec makeSceneSpec() {
  ParameterSpec scene = object(
      "scene", "A scene.",
      {integer("schema_version", "", "Version of this format: 1.", schemaVersion, schemaVersion),
       withDefault(text("title", "A few words, shown in the window."), ""),
       withDefault(text("description", "A sentence or more about the scene."), ""),
       withDefault(
           integer("dimension", "d", "Number of coordinates of a node; every vector has as many entries.", 1, 3), 3),
       withDefault(choice("mass_matrix", "How the mass of elements acts: on the nodes alone, or coupling neighbours.",
                          {"lumped", "consistent"}),
                   "lumped"),
       entries("geometry", "Nodes and triangles.", geometries()),
       entries("materials", "What elements are made of.", materialSpecs()),
       entries("elements", "Elastic bodies.", elementSpecs()),
       entries("point_masses", "Masses on nodes; each is a design parameter.", pointMasses()),
       entries("springs", "Springs.", springs()),
       entries("seams", "Edges that are sewn together.", seamSpecs()),
       entries("stretch_limits", "How far cloth may stretch.", stretchLimitSpecs()),
       entries("boundary_conditions", "Nodes that cannot move.", boundaryConditions()),
       entries("bodies", "What cloth lies on.", bodySpecs()),
       withDefault(contactSpec(), Json::object()),
       entries("drives", "Nodes that are moved.", drives()),
       entries("loads", "Forces.", loads()),
       withDefault(object("damping", "Rayleigh damping D = D_α M + D_β K(x).",
                          {withDefault(notNegative(number(
                                           "mass_proportional", "D_α", "Factor of the mass matrix.", dimensions::rate)),
                                       0),
                           withDefault(notNegative(number("stiffness_proportional", "D_β",
                                                          "Factor of the tangent stiffness matrix.", dimensions::time)),
                                       0)}),
                   Json::object()),
       entries("parameters", "Numbers of the scene as design parameters, besides the point masses.",
               object("parameter", "A number of the scene that a designer may change: the window gives it a slider.",
                      {name(),
                       text("pointer",
                            "JSON pointer of the number, such as \"/elements/0/thickness\", or of a study's "
                            "frequency, \"/studies/0/frequency\"."),
                       optional(number("minimum", "", "Smallest value in design, in SI; half the value if left out.",
                                       dimensions::none)),
                       optional(number("maximum", "", "Largest value in design, in SI; twice the value if left out.",
                                       dimensions::none))})),
       entries("interlocking_cells", "Materials of interlocking elements.",
               variant("interlocking_cell", "Rigid elements that hold each other, repeated over a plane.",
                       interlockingCellSpecs())),
       entries("probes", "Nodes whose motion is reported.",
               object("probe", "A node whose trajectory and amplitude are reported.",
                      {name(), selection("at", "One node.")})),
       entries("studies", "What to compute.", variant("study", "A computation.", studySpecs())),
       entries("expected", "Values that the studies must give.", expectedValues())});
  return scene;
}

}  // namespace

const base::ParameterSpec& sceneSpec() {
  static const base::ParameterSpec spec = makeSceneSpec();
  return spec;
}

}  // namespace pliant::scene
