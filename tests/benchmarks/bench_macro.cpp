#include "tests/benchmarks/bench_macro.hpp"

#include <cstdio>

#include "core/scene/macro_result.hpp"
#include "core/scene/model_builder.hpp"

namespace pliant::bench {

namespace {

using base::Json;

struct MacroCase {
  const char* scene;  ///< in scenes/interlock, after "macro_"
  double thesisNative, thesisMacro;
};

constexpr MacroCase cases[] = {
    {"threefold_a", 133.526, 68.394},  {"threefold_b", 883.701, 61.104},  {"threefold_c", 1883.044, 61.734},
    {"torus_knot_a", 216.75, 78.618},  {"torus_knot_b", 722.203, 97.602}, {"torus_knot_c", 1647.41, 141.261},
    {"scale_mail_a", 179.057, 43.581}, {"scale_mail_b", 962.517, 36.821}, {"scale_mail_c", 4929.636, 40.755},
};

}  // namespace

Json measureMacro() {
  std::printf(
      "0.5 N on the middle of patches held at their corners (Table 4.1). Times in seconds; deflections under the "
      "load,\n"
      "and distances between the sheet and the origins of the elements, over the size of the patch.\n\n"
      "%-16s %9s %9s %7s %9s %9s %7s %6s %9s %9s %8s %8s\n",
      "patch", "native", "thesis", "ratio", "macro", "thesis", "ratio", "iter.", "native", "macro", "mean", "largest");
  Json rows = Json::array();
  for (const MacroCase& one : cases) {
    const scene::Scene scene =
        scene::Scene::load(std::string(PLIANT_SOURCE_DIR "/scenes/interlock/macro_") + one.scene + ".json");
    base::ExecutionContext context;
    const auto result = std::dynamic_pointer_cast<const scene::MacroResult>(
        scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "press")->run(context));
    const scene::MacroResult::Native& native = *result->native;
    const double seconds = result->state.report.seconds;
    const double mean = native.meanDistance / native.size, largest = native.largestDistance / native.size;
    const auto row = [&](const char* kind, double own, double thesis, std::size_t size, std::size_t iterations,
                         double deflection) {
      rows.push_back(Json{{"area", "macro"},
                          {"name", std::string("macro/") + one.scene + "/" + kind},
                          {"seconds", own},
                          {"iterations", iterations},
                          {"unavoidable_seconds", nullptr},
                          {"thesis_seconds", thesis},
                          {"size", size},
                          {"deflection", deflection},
                          {"mean_distance_over_size", mean},
                          {"largest_distance_over_size", largest},
                          {"converged", result->termination == base::TerminationType::converged}});
    };
    const std::size_t iterations = result->state.report.iterations.size() - 1;
    row("native", native.seconds, one.thesisNative, native.patch->elements.size(),
        static_cast<std::size_t>(native.rest.iterations), native.deflections(2, 0));
    row("sheet", seconds, one.thesisMacro, result->sheet->mesh.triangles.size(), iterations, result->deflections(2, 0));
    std::printf("%-16s %9.2f %9.1f %7.0f %9.3f %9.1f %7.0f %6zu %6.2f mm %6.2f mm %6.1f %% %6.1f %%%s\n", one.scene,
                native.seconds, one.thesisNative, one.thesisNative / native.seconds, seconds, one.thesisMacro,
                one.thesisMacro / seconds, iterations, 1e3 * native.deflections(2, 0), 1e3 * result->deflections(2, 0),
                100 * mean, 100 * largest,
                result->termination == base::TerminationType::converged ? "" : "  not converged");
    std::fflush(stdout);
  }
  return rows;
}

}  // namespace pliant::bench
