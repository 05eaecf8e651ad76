#include "core/scene/composed_cell_specs.hpp"

#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

constexpr int mostEntries = 10'000, mostCorners = 100'000;

/// A vector of three components, whatever the scene's dimension is.
ParameterSpec triple(std::string key, std::string description, base::Dimension dimension) {
  return list(std::move(key), std::move(description), number("", "", "A component.", dimension), 3, 3);
}

ParameterSpec place(std::string key, std::string description) {
  return withDefault(triple(std::move(key), std::move(description), dimensions::length), {0, 0, 0});
}

ParameterSpec length(std::string key, std::string symbol, std::string description) {
  return positive(number(std::move(key), std::move(symbol), std::move(description), dimensions::length));
}

ParameterSpec meshFile(std::string description) {
  ParameterSpec path = text("file", std::move(description));
  path.kind = base::ValueKind::path;
  return path;
}

ParameterSpec turn(std::string description) {
  return optional(object(
      "rotation", std::move(description),
      {withDefault(triple("axis", "Axis through the origin; only its direction counts.", dimensions::none), {0, 0, 1}),
       number("angle", "", "Counter-clockwise seen against the axis.", dimensions::angle)}));
}

ParameterSpec cornerTuples(std::string key, std::string description, int corners) {
  return withDefault(
      list(std::move(key), std::move(description),
           list("", "Corners.", integer("", "", "A corner.", 0, mostCorners - 1), corners, corners), 0, mostCorners),
      Json::array());
}

ParameterSpec piece() {
  const auto kind = [](std::string type, std::string description, std::vector<ParameterSpec> keys) {
    keys.push_back(length("radius", "r", "All places nearer than this to the curve or the simplices are solid."));
    return object(std::move(type), std::move(description), std::move(keys));
  };
  const auto mesh = object(
      "mesh",
      "A body whose surface is a closed mesh of triangles that face outwards and do not run into each other. Corners "
      "nearer to each other than a millionth of its size are joined. Each of its handles can be linked, see "
      "\"handle_a\".",
      {meshFile("STL, OBJ, PLY or glTF, relative to the scene."),
       withDefault(positive(number("scale", "", "Metres of a unit of the file.", dimensions::none)), 1),
       withDefault(notNegative(number("radius", "r", "All places nearer than this to the body are solid as well.",
                                      dimensions::length)),
                   0),
       place("center", "Where the file's origin is."), turn("Turns the mesh about the file's origin.")});
  const auto center = place("center", "Its centre.");
  return variant(
      "piece", "A closed curve, simplices or a mesh, with a radius. Pieces of a shape may overlap one another.",
      {kind("circle", "A ring.",
            {length("ring_radius", "R", "From the centre to the middle of the wire."), center,
             withDefault(
                 triple("normal", "Axis of the ring; only its direction counts.", dimensions::none), {0, 0, 1})}),
       kind("ellipse", "The curve center + first cos t + second sin t.",
            {triple("first", "From the centre to the curve.", dimensions::length),
             triple("second", "From the centre to the curve, a quarter later.", dimensions::length), center}),
       kind(
           "torus_curve", "The curve ((A + B cos qt) cos pt, (A + B cos qt) sin pt, C sin qt), turned and moved.",
           {integer("p", "p", "Turns about the axis.", 1, 20), integer("q", "q", "Turns about the ring's core.", 1, 20),
            length("a", "A", "Radius of the core."), length("b", "B", "Half width."), length("c", "C", "Half height."),
            center, turn("Turns the curve before it is moved.")}),
       kind("series", "The closed curve center + Σ cosine cos(order t) + sine sin(order t).",
            {list("terms", "Terms of the series.",
                  object(
                      "term", "One term.",
                      {integer("order", "k", "Multiple of t.", 1, 100), place("cosine", "Coefficient of cos(order t)."),
                       place("sine", "Coefficient of sin(order t).")}),
                  1, 100),
             center}),
       kind("simplices", "Points, segments and triangles: balls, rods, and plates with rounded rims.",
            {list("corners", "Places that the others name by their index, counted from 0.",
                  triple("", "A place.", dimensions::length), 1, mostCorners),
             withDefault(list("points", "Corners that are points by themselves.",
                              integer("", "", "A corner.", 0, mostCorners - 1), 0, mostCorners),
                         Json::array()),
             cornerTuples("segments", "Two corners each.", 2), cornerTuples("triangles", "Three corners each.", 3),
             withDefault(boolean("closed",
                                 "Whether segments must form loops, which can be linked, and triangles a surface "
                                 "without rim."),
                         false)}),
       mesh});
}

}  // namespace

std::vector<ParameterSpec> composedCellKeys() {
  const auto element = [](std::string key, std::string description) {
    return integer(std::move(key), "", std::move(description), 0, mostEntries - 1);
  };
  return {
      list("lattice", "Two translations (x, y) that repeat the cell over the plane.",
           list("", "A translation.", number("", "", "A component.", dimensions::length), 2, 2), 2, 2),
      list("shapes", "Rigid bodies that elements are copies of.",
           object("shape", "A rigid body, which turns about its origin.",
                  {name(), list("pieces", "What it is made of.", piece(), 1, mostEntries),
                   optional(length("contact_length", "",
                                   "What final gaps and perturbations are measured by, in place of the least radius of "
                                   "all wires. That of a mesh is 2V/A, the radius of a wire of the same volume and "
                                   "surface."))}),
           1, mostEntries),
      list("elements", "The elements of one cell.",
           object("element", "A shape, turned and moved.",
                  {text("shape", "Name of the shape."), place("position", "Where its origin is."),
                   turn("Turns it about its origin.")}),
           1, mostEntries),
      withDefault(
          list("links",
               "Closed pieces of neighbours that are linked at rest: all of them, each once. Elements and pieces are "
               "counted from 0.",
               object("link", "Two closed pieces that hold each other.",
                      {element("a", "An element."), withDefault(element("piece_a", "Its piece."), 0),
                       element("b", "Another element, or the same."), withDefault(element("piece_b", "Its piece."), 0),
                       withDefault(element("handle_a", "Of a mesh with several handles: which of them."), 0),
                       withDefault(element("handle_b", "Of a mesh with several handles: which of them."), 0),
                       withDefault(list("shift", "Lattice vectors by which b is moved.",
                                        integer("", "", "Times a lattice vector.", -1000, 1000), 2, 2),
                                   {0, 0}),
                       withDefault(
                           integer("number", "", "Gauss linking number, with the sign that the curves' senses give.",
                                   -1000, 1000),
                           1)}),
               0, mostEntries),
          Json::array())};
}

}  // namespace pliant::scene
