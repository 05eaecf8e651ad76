#include "core/scene/spec_builder.hpp"

namespace pliant::scene::spec {

using base::ValueKind;
namespace dimensions = base::dimensions;

namespace {

ParameterSpec make(std::string key, std::string description, ValueKind kind) {
  ParameterSpec spec;
  spec.key = std::move(key);
  spec.description = std::move(description);
  spec.kind = kind;
  return spec;
}

}  // namespace

ParameterSpec number(std::string key, std::string symbol, std::string description, Dimension dimension) {
  ParameterSpec spec = make(std::move(key), std::move(description), ValueKind::number);
  spec.symbol = std::move(symbol);
  spec.dimension = dimension;
  return spec;
}

ParameterSpec integer(std::string key, std::string symbol, std::string description, int minimum, int maximum) {
  ParameterSpec spec = make(std::move(key), std::move(description), ValueKind::integer);
  spec.symbol = std::move(symbol);
  return within(std::move(spec), minimum, maximum);
}

ParameterSpec boolean(std::string key, std::string description) {
  return make(std::move(key), std::move(description), ValueKind::boolean);
}

ParameterSpec text(std::string key, std::string description) {
  return make(std::move(key), std::move(description), ValueKind::text);
}

ParameterSpec name() { return make("name", "Unique in its list.", ValueKind::name); }

ParameterSpec reference(std::string key, std::string description, std::string target) {
  ParameterSpec spec = make(std::move(key), std::move(description), ValueKind::reference);
  spec.target = std::move(target);
  return spec;
}

ParameterSpec choice(std::string key, std::string description, std::vector<std::string> choices) {
  ParameterSpec spec = make(std::move(key), std::move(description), ValueKind::choice);
  spec.choices = std::move(choices);
  return spec;
}

ParameterSpec object(std::string key, std::string description, std::vector<ParameterSpec> fields) {
  ParameterSpec spec = make(std::move(key), std::move(description), ValueKind::object);
  spec.fields = std::move(fields);
  return spec;
}

ParameterSpec variant(std::string key, std::string description, std::vector<ParameterSpec> items) {
  ParameterSpec spec = make(std::move(key), std::move(description), ValueKind::variant);
  spec.items = std::move(items);
  return spec;
}

ParameterSpec list(std::string key, std::string description, ParameterSpec item, int minimumCount, int maximumCount) {
  ParameterSpec spec = make(std::move(key), std::move(description), ValueKind::list);
  spec.items = {std::move(item)};
  spec.minimumCount = minimumCount;
  spec.maximumCount = maximumCount;
  return spec;
}

ParameterSpec vector(std::string key, std::string description, Dimension dimension) {
  ParameterSpec spec = list(std::move(key), std::move(description), number("", "", "A coordinate.", dimension), 1, 3);
  spec.spatial = true;
  return spec;
}

ParameterSpec selection(std::string key, std::string description) {
  ParameterSpec spec = object(
      std::move(key), std::move(description),
      {optional(reference("geometry", "Whose nodes; may be left out where the scene has one geometry.", "geometry")),
       optional(list(
           "nodes", "Indices of nodes, counted from 0.", integer("", "", "A node.", 0, 1'000'000'000), 1, 1'000'000)),
       optional(text("group", "A named group of the geometry, such as \"base\".")),
       optional(vector("nearest", "The one node that rests nearest to this place.", dimensions::length)),
       optional(object("box", "All nodes that rest inside this box, its faces included.",
                       {vector("minimum", "The lower corner.", dimensions::length),
                        vector("maximum", "The upper corner.", dimensions::length)}))});
  spec.exactlyOne = {"nodes", "group", "nearest", "box"};
  return spec;
}

ParameterSpec signal(std::string description, Dimension amplitude) {
  return list("harmonics", std::move(description),
              object("harmonic", "One term: amplitude cos(order τ + phase), τ = ω t.",
                     {withDefault(integer("order", "k", "Multiple of the driving frequency.", 0, 200), 1),
                      optional(choice("of",
                                      "Which driving frequency of the study it is a multiple of; \"frequency\" if "
                                      "left out.",
                                      {"frequency", "second_frequency"})),
                      number("amplitude", "a", "Amplitude.", amplitude),
                      withDefault(number("phase", "φ", "Phase at t = 0.", dimensions::angle), 0)}),
              1, 100);
}

ParameterSpec positive(ParameterSpec spec) {
  spec.minimum = 0;
  spec.exclusiveMinimum = true;
  return spec;
}

ParameterSpec notNegative(ParameterSpec spec) {
  spec.minimum = 0;
  return spec;
}

ParameterSpec within(ParameterSpec spec, double minimum, double maximum) {
  spec.minimum = minimum;
  spec.maximum = maximum;
  return spec;
}

ParameterSpec withDefault(ParameterSpec spec, Json value) {
  spec.defaultValue = std::move(value);
  return spec;
}

ParameterSpec optional(ParameterSpec spec) {
  spec.optional = true;
  return spec;
}

}  // namespace pliant::scene::spec
