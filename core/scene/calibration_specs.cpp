#include "core/scene/calibration_specs.hpp"

#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

std::vector<base::ParameterSpec> calibrationKeys() {
  ParameterSpec file = text("file",
                            "A table with a column \"time [s]\" and columns like \"tip x [mm]\": a probe, an axis, a "
                            "unit of length; cells may be empty. Relative to the scene.");
  file.kind = base::ValueKind::path;
  return {
      list("parameters",
           "Names of point masses and of entries of \"parameters\" that are fitted within their bounds, from the "
           "scene's values.",
           text("", "A name."), 1, 1000),
      list("measurements", "Steady motions that were measured.",
           object("measurement", "One motion.",
                  {file, positive(number("frequency", "ω", "Driving frequency.", dimensions::angularFrequency)),
                   withDefault(choice("values",
                                      "What was measured: positions in the scene's frame, displacements from where "
                                      "nodes rest, or swings about places that are not known and are estimated, one a "
                                      "column.",
                                      {"positions", "displacements", "swings"}),
                               "positions"),
                   optional(number("time_offset", "",
                                   "The drive's time when the table's time is 0; estimated if left out.",
                                   dimensions::time)),
                   optional(list("axes", "Only columns of these axes count; all if left out.",
                                 choice("", "An axis.", {"x", "y", "z"}), 1, 3))}),
           1, 1000),
      withDefault(
          within(number("confidence", "", "Level of the confidence intervals.", dimensions::none), 0.01, 0.9999), 0.95),
      withDefault(integer("iterations", "", "Iterations of the fit.", 0, 10'000), 50),
      withDefault(choice("stability", "Whether to find the stability of the fitted motions.", {"on", "off"}), "on"),
      withDefault(
          positive(number("largest_step", "", "Largest change in an iteration, relative to a parameter's range.",
                          dimensions::none)),
          0.3)};
}

}  // namespace pliant::scene
