#include "core/scene/cloth_specs.hpp"
#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

ParameterSpec smallNumber(std::string key, std::string description, double value) {
  return withDefault(positive(number(std::move(key), "", std::move(description), dimensions::none)), value);
}

/// What every study of cloth says about limits, after its `own` keys.
ParameterSpec clothStudy(std::string type, std::string description, std::vector<ParameterSpec> own,
                         std::vector<std::string> methods, std::vector<ParameterSpec> last) {
  std::vector<ParameterSpec> keys{name()};
  keys.insert(keys.end(), own.begin(), own.end());
  keys.push_back(withDefault(
      choice("limit_method",
             "How stretch limits are kept: \"cone\" finds the global optimum and proves it, \"gauss_seidel\" goes from "
             "triangle to triangle, \"nonlinear_program\" is a general solver.",
             std::move(methods)),
      "cone"));
  keys.push_back(smallNumber("relative_gap", "\"cone\": duality gap over objective at which a projection ends.", 1e-8));
  keys.push_back(
      smallNumber("violation", "\"gauss_seidel\": stretch over limit - 1 at which a projection ends.", 1e-6));
  keys.push_back(withDefault(
      integer("maximum_sweeps", "", "\"gauss_seidel\": after which it gives up.", 1, 100'000'000), 100'000));
  keys.insert(keys.end(), last.begin(), last.end());
  return object(std::move(type), std::move(description), std::move(keys));
}

ParameterSpec normChoice() {
  return withDefault(
      choice("norm",
             "Distance that a projection makes small: weighted by \"mass\", which keeps momentum, or the "
             "same for all nodes (thesis 3.3.2).",
             {"mass", "identity"}),
      "mass");
}

ParameterSpec newtonTolerance() {
  return smallNumber("newton_tolerance",
                     "Where Newton's method ends: root mean square of how far the unbalanced force moves nodes in a "
                     "step, over the size of the model.",
                     1e-8);
}

}  // namespace

std::vector<ParameterSpec> clothStudySpecs() {
  const std::vector<std::string> methods{"cone", "gauss_seidel", "nonlinear_program", "none"};
  ParameterSpec candidate = text("candidate", "A PLY or CSV file, relative to the scene, with a position a node.");
  candidate.kind = base::ValueKind::path;
  return {
      clothStudy(
          "cloth_motion", "The motion of cloth from rest, with stretch limits kept at the end of every step.",
          {withDefault(
               choice("scheme",
                      "How time is stepped; see core/cloth. The first two keep no limits, \"step_and_reflect\" is the "
                      "thesis's SAR, \"bdf2_and_project\" is of second order.",
                      {"implicit_euler", "bdf2", "step_and_project", "step_and_reflect", "bdf2_and_project",
                       "bdf2_and_reflect", "second_order_reflect"}),
               "step_and_reflect"),
           withDefault(positive(number("time_step", "Δt", "Step of time.", dimensions::time)), "10 ms"),
           positive(number("duration", "", "How long.", dimensions::time))},
          methods,
          {normChoice(), newtonTolerance(),
           withDefault(integer("frame_every", "", "Steps from one kept frame to the next.", 1, 1'000'000), 1)}),
      clothStudy(
          "cloth_drape", "The static equilibrium of cloth under its weight and its stretch limits.",
          {withDefault(
               number("time", "t", "At which pins and bodies are taken from their paths.", dimensions::time), 0),
           withDefault(
               positive(number("time_step", "h", "Of the first step; it adapts itself.", dimensions::time)), "50 ms"),
           smallNumber("tolerance",
                       "Force that neither elasticity nor limits balance, over the external force, at which it "
                       "ends.",
                       1e-4),
           withDefault(integer("maximum_steps", "", "After which it gives up.", 1, 1'000'000), 2000)},
          methods,
          {newtonTolerance(),
           withDefault(integer("frame_every", "", "Steps from one kept frame to the next.", 1, 1'000'000), 5)}),
      clothStudy("projection", "The positions nearest to given ones that keep the stretch limits, with their proof.",
                 {candidate}, {"cone", "gauss_seidel", "nonlinear_program"}, {normChoice()})};
}

}  // namespace pliant::scene
