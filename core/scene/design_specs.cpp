#include "core/scene/design_specs.hpp"

#include "core/scene/design_constraint_specs.hpp"
#include "core/scene/resonance_goals.hpp"
#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

constexpr int longestDesignList = 1'000'000;
constexpr int mostSplinePoints = 200;

ParameterSpec positiveNumber(std::string key, std::string symbol, std::string description, double value) {
  return withDefault(
      positive(number(std::move(key), std::move(symbol), std::move(description), dimensions::none)), value);
}

ParameterSpec objectives() {
  const ParameterSpec probe = reference("probe", "Which node.", "probes");
  const ParameterSpec weight = withDefault(
      number("weight", "", "Factor in the sum of all objectives, which is made small.", dimensions::none), 1);
  ParameterSpec file = optional(
      text("file", "A table with the columns \"x [m]\", \"y [m]\", ..., a row a point; relative to the scene."));
  file.kind = base::ValueKind::path;
  ParameterSpec path =
      object("path", "A closed path that one node is to run along.",
             {probe,
              optional(list("points",
                            "Places that it passes at even steps of time, in order; the first follows the "
                            "last.",
                            vector("", "A place.", dimensions::length), 3, longestDesignList)),
              optional(list("spline",
                            "Places that a closed cubic spline passes at even steps of time, in order: few points, as "
                            "drawn by hand.",
                            vector("", "A place.", dimensions::length), 3, mostSplinePoints)),
              file});
  path.exactlyOne = {"points", "spline", "file"};
  ParameterSpec all = variant(
      "objective", "What is to be reached.",
      {object("amplitude",
              "The length of the paths of some nodes over a period, Σ (A - target)² (thesis 2.4.8), or -Σ A.",
              {list("probes", "Which nodes.", reference("", "A probe.", "probes"), 1, 1000),
               optional(notNegative(
                   number("target", "Ā", "Wanted length; as long as possible if left out.", dimensions::length))),
               optional(list("axes", "Only motion along these axes counts; along all if left out.",
                             choice("", "An axis.", {"x", "y", "z"}), 1, 3)),
               weight}),
       object(
           "path",
           "Distance of the motion's Fourier coefficients from those of target paths, whatever the phase "
           "(thesis 2.4.6, 2.4.7).",
           {list("paths", "Paths of nodes, all with one phase.", path, 1, 1000),
            withDefault(
                boolean("match_place", "Whether the middle of the path counts as well, not its shape alone."), false),
            positiveNumber("sharpness", "", "Of the smooth minimum over phases: α times the targets' Σ ŝ² + ĉ².", 1000),
            withDefault(integer("phases", "N", "Phases that are tried.", 1, 100'000), 256), weight}),
       object("regularization",
              "Σ ((p - p₀) / (maximum - minimum))² over the parameters that may change, p₀ being the scene's values.",
              {weight})});
  for (ParameterSpec& goal : resonanceGoalSpecs(weight)) all.items.push_back(std::move(goal));
  return all;
}

}  // namespace

std::vector<base::ParameterSpec> designKeys() {
  return {
      positive(number("frequency", "ω", "Driving frequency.", dimensions::angularFrequency)),
      optional(list("parameters",
                    "Names of point masses and of entries of \"parameters\" that may change within their bounds; all "
                    "if neither these nor \"stiffness_factors\" are given.",
                    text("", "A name."), 1, longestDesignList)),
      optional(list("stiffness_factors", "Young's modulus of each triangle or tetrahedron may change.",
                    object("stiffness_factor", "Factors of the elements of one entry.",
                           {reference("element", "A membrane or solid.", "elements"),
                            optional(positive(number("initial", "",
                                                     "That all factors start from; the element's own "
                                                     "\"stiffness_factors\" if left out.",
                                                     dimensions::none))),
                            positiveNumber("minimum", "", "Smallest factor.", 0.1),
                            positiveNumber("maximum", "", "Largest factor.", 10)}),
                    1, 1000)),
      list("objectives", "What is to be reached; several are summed up.", objectives(), 1, 1000),
      designConstraints(),
      withDefault(integer("starts", "",
                          "Designs to begin with, the best result of which counts: the scene's own and the most "
                          "promising of four times as many between the bounds.",
                          1, 1000),
                  1),
      withDefault(integer("seed", "", "Of the designs between the bounds.", 0, 1'000'000'000), 1),
      withDefault(integer("iterations", "", "Iterations of the optimiser.", 0, 100'000), 200),
      positiveNumber(
          "objective_tolerance", "",
          "The design counts as best if two iterations improve the objective by less each, relative to itself.", 1e-6),
      positiveNumber("gradient_tolerance", "",
                     "It also does where the gradient that the bounds leave has fallen to this fraction of the first "
                     "one.",
                     1e-5),
      withDefault(
          choice("stability", "Whether to find the stability of the last design's motion.", {"on", "off"}), "on"),
      positiveNumber("first_step", "", "Largest first change of a parameter, relative to its range.", 0.1),
      positiveNumber("largest_step", "", "Largest change in an iteration, relative to its range.", 0.3)};
}

}  // namespace pliant::scene
