#include "core/scene/design_space_specs.hpp"

#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

ParameterSpec goal() {
  return withDefault(choice("goal", "Which values are better.", {"largest", "smallest"}), "largest");
}

ParameterSpec probe() { return reference("probe", "Which node.", "probes"); }

}  // namespace

std::vector<base::ParameterSpec> designSpaceKeys() {
  return {
      positive(number("frequency", "ω", "Driving frequency.", dimensions::angularFrequency)),
      optional(list("parameters",
                    "Names of point masses and of entries of \"parameters\" that differ between designs, each between "
                    "its bounds; all if left out.",
                    text("", "A name."), 1, 1000)),
      withDefault(integer("count", "", "Designs, besides the scene's own.", 1, 100'000), 100),
      withDefault(integer("seed", "", "Of where the even points begin.", 0, 1'000'000'000), 1),
      list(
          "measures", "Two numbers of each design that are set against each other.",
          variant(
              "measure", "A number.",
              {object("path_length", "The length of a node's path over a period.", {probe(), goal()}),
               object("displacement", "How far a node is from its mean place at most.", {probe(), goal()}),
               object("total_mass", "The mass of the whole model.",
                      {withDefault(choice("goal", "Which values are better.", {"largest", "smallest"}), "smallest")})}),
          2, 2)};
}

}  // namespace pliant::scene
