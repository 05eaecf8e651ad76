#include "core/scene/cloth_specs.hpp"

#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

constexpr int mostPoints = 1'000'000;
constexpr base::Dimension velocity{0, 1, -1, 0};

/// Three entries whatever the scene's dimension: cloth lives in space.
ParameterSpec inSpace(std::string key, std::string description, base::Dimension dimension) {
  return list(std::move(key), std::move(description), number("", "", "A component.", dimension), 3, 3);
}

ParameterSpec stretch(std::string key, std::string symbol, std::string description) {
  return positive(number(std::move(key), std::move(symbol), std::move(description), dimensions::none));
}

/// A limit: what is its own between its name and what every limit has.
ParameterSpec stretchLimit(std::string type, std::string description, std::vector<ParameterSpec> own, bool sampled) {
  std::vector<ParameterSpec> keys{name()};
  keys.insert(keys.end(), own.begin(), own.end());
  keys.push_back(optional(
      reference("element", "The shell or membrane that it limits; may be left out where there is one.", "elements")));
  keys.push_back(optional(text("group", "Only triangles all of whose nodes are in this group of its geometry.")));
  keys.push_back(withDefault(
      inSpace("direction",
              "The material's first direction in the rest shape, projected onto each triangle: angles count from it.",
              dimensions::none),
      {1, 0, 0}));
  if (sampled)
    keys.push_back(optional(
        integer("directions", "m",
                "Limit this many equally spaced directions alone, in place of all of them (thesis 3.3.1); in between "
                "the stretch may then exceed the limit.",
                2, 90)));
  return object(std::move(type), std::move(description), std::move(keys));
}

ParameterSpec file(std::string key, std::string description) {
  ParameterSpec path = text(std::move(key), std::move(description));
  path.kind = base::ValueKind::path;
  return path;
}

ParameterSpec scale(std::string description) {
  return withDefault(positive(number("scale", "", std::move(description), dimensions::none)), 1);
}

}  // namespace

ParameterSpec motionSpec(std::string description) {
  return withDefault(
      list(
          "path", std::move(description),
          object("keyframe", "Where it is at one time; linear in between, at rest before the first and after the last.",
                 {number("time", "t", "When; ascending.", dimensions::time),
                  withDefault(inSpace("translation", "From where it rests.", dimensions::length), {0, 0, 0}),
                  withDefault(
                      inSpace("axis", "Axis of a turn about its centre; only the direction counts.", dimensions::none),
                      {0, 0, 1}),
                  withDefault(number("angle", "", "Angle of the turn, counter-clockwise seen against the axis.",
                                     dimensions::angle),
                              0)}),
          0, 10'000),
      Json::array());
}

ParameterSpec seamSpecs() {
  return object(
      "seam",
      "Sews two edges of surfaces together, node to node: sewn nodes become one, which starts in their middle. Both "
      "edges are connected pieces of a boundary with as many nodes as each other. They may belong to one geometry.",
      {name(), selection("from", "Nodes of one edge."), selection("to", "Nodes of the other."),
       withDefault(
           boolean("reverse",
                   "Edges are joined the way round on which their nodes are nearer to each other; the other way "
                   "round if true."),
           false)});
}

ParameterSpec stretchLimitSpecs() {
  return variant(
      "stretch_limit",
      "How far triangles may stretch, as length over rest length. Of several limits for a triangle the last counts.",
      {stretchLimit("isotropic", "The same in every direction.",
                    {stretch("stretch", "b", "The largest length over rest length, at least 1.")}, true),
       stretchLimit(
           "orthotropic", "Two limits across each other, and in between b(α)² = b₁² cos²(α - α₀) + b₂² sin²(α - α₀).",
           {stretch("first", "b₁", "The limit along the angle."), stretch("second", "b₂", "The limit across it."),
            withDefault(number("angle", "α₀", "From the material's first direction.", dimensions::angle), 0)},
           true),
       stretchLimit(
           "curve", "A smooth curve b(α) with period π through points; it has no extrema besides them.",
           {list("points", "Points of the curve; angles must differ by more than multiples of π.",
                 object("point", "One point.",
                        {number("angle", "α", "From the material's first direction.", dimensions::angle),
                         stretch("stretch", "b", "The limit there.")}),
                 1, 1000),
            withDefault(choice("constraints",
                               "What keeps it: \"ellipses\", whose intersection contains the curve, \"directions\", or "
                               "whichever lets less through.",
                               {"auto", "ellipses", "directions"}),
                        "auto"),
            withDefault(integer("count", "m", "Ellipses or directions.", 1, 90), 12)},
           false)});
}

ParameterSpec bodySpecs() {
  const ParameterSpec path = motionSpec("How it moves.");
  const ParameterSpec radius = positive(number("radius", "", "Radius.", dimensions::length));
  return variant(
      "body", "What cloth and sheets of interlocking materials lie on or are moved by, in studies of these.",
      {object("sphere", "A sphere.", {name(), inSpace("center", "Its centre.", dimensions::length), radius, path}),
       object("capsule", "A cylinder with round ends.",
              {name(), inSpace("from", "The centre of one end.", dimensions::length),
               inSpace("to", "The centre of the other.", dimensions::length), radius, path}),
       object("ground", "A square plate, of no thickness.",
              {name(), withDefault(inSpace("point", "Its middle.", dimensions::length), {0, 0, 0}),
               withDefault(inSpace("normal", "Across it; only the direction counts.", dimensions::none), {0, 0, 1}),
               withDefault(positive(number("size", "", "Of a side.", dimensions::length)), "2 m"), path}),
       object("mesh", "Triangles read from an STL, OBJ, PLY or glTF file.",
              {name(), file("file", "The file, relative to the scene."), scale("Metres per unit of the file."),
               withDefault(inSpace("position", "Where the file's origin is put.", dimensions::length), {0, 0, 0}),
               optional(object(
                   "rotation", "Turns it about its origin before it is put in place.",
                   {withDefault(
                        inSpace("axis", "Axis of rotation; only its direction counts.", dimensions::none), {0, 0, 1}),
                    number("angle", "", "Angle, counter-clockwise seen against the axis.", dimensions::angle)})),
               withDefault(notNegative(number(
                               "thickness", "", "What its surface is thickened by on each side.", dimensions::length)),
                           0),
               path})});
}

ParameterSpec contactSpec() {
  return object("contact", "Contact in studies of cloth and of sheets of interlocking materials.",
                {withDefault(positive(number("distance", "", "Gap below which surfaces begin to push each other.",
                                             dimensions::length)),
                             "1 mm"),
                 withDefault(boolean("self_contact", "Whether the sheet also touches itself."), false),
                 withDefault(within(number("friction", "μ",
                                           "Coulomb's coefficient of all contacts of a sheet of interlocking material; "
                                           "0: none. Cloth slides without friction.",
                                           dimensions::none),
                                    0, 10),
                             0)});
}

ParameterSpec pinSpec() {
  return object(
      "pin", "All coordinates of nodes follow a path in studies of cloth; other studies hold them where they rest.",
      {name(), selection("at", "Nodes."), motionSpec("How they move, turning about their mean position."),
       optional(notNegative(number("release", "", "When they are let go; never if left out.", dimensions::time)))});
}

ParameterSpec windSpec() {
  return object(
      "wind",
      "Air that streams past shells and membranes, in studies of cloth: a triangle of area A and normal n feels "
      "½ ρ c A |u| u n, with u the air's velocity against it along n.",
      {name(), inSpace("velocity", "Of the air.", velocity),
       withDefault(notNegative(number("air_density", "ρ", "Mass per volume of the air.", dimensions::density)), 1.2),
       withDefault(notNegative(number("drag", "c", "Coefficient along the normal.", dimensions::none)), 1),
       withDefault(
           number("gust", "", "The velocity is multiplied by 1 + gust sin(2π t / gust_period).", dimensions::none), 0),
       withDefault(positive(number("gust_period", "", "Period of the gusts.", dimensions::time)), 1)});
}

ParameterSpec patternSpec() {
  ParameterSpec spec = object(
      "pattern",
      "Another rest shape with the same triangles in the same order, such as the flat pieces of a garment; the "
      "geometry "
      "is then only where it starts. Where a node rests in several places the sheet is sewn together from pieces: it "
      "bends over such a seam as if ironed flat.",
      {optional(file("path", "A mesh file, relative to the scene.")),
       optional(choice(
           "from", "The texture coordinates of the geometry's own file, as programs that design garments write them.",
           {"texture_coordinates"})),
       scale("Metres per unit of the file, or of its texture coordinates."),
       optional(list("points", "Rest positions of the geometry's nodes, in their order.",
                     inSpace("", "A position.", dimensions::length), 1, mostPoints))});
  spec.exactlyOne = {"path", "from", "points"};
  return optional(spec);
}

}  // namespace pliant::scene
