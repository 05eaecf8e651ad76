#include "tests/benchmarks/bench_design.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "core/base/stopwatch.hpp"
#include "core/harmonic/prediction_error.hpp"
#include "core/scene/design_result.hpp"
#include "core/scene/model_builder.hpp"

namespace pliant::bench {

namespace {

using scene::Json;

/// A row of Table 2.1 (Intel Core i9-7900X, 3.3 GHz), and the scene that stands for it.
struct Example {
  const char* name;
  const char* file;
  int freedoms, harmonics, samples, parameters, iterations;
  double seconds;
};
constexpr Example examples[] = {
    {"dragon", "dragon", 780, 8, 64, 3, 12, 1098.09},       {"three-link", "three_link", 8, 8, 64, 16, 146, 34.89},
    {"ostrich", "ostrich_leg", 14, 14, 64, 7, 128, 163.98}, {"fish", "fish", 187, 8, 64, 3, 46, 456.96},
    {"solid", "t_solid", 918, 8, 64, 7, 10, 7926.43},       {"eiffel", "eiffel", 658, 8, 64, 525, 150, 5534.82}};

/// What the design has reached: path errors, or the gain of the first probe.
std::string reached(const Json& summary) {
  char text[80] = "";
  if (summary.contains("paths"))
    std::snprintf(text, sizeof(text), "off its path by %.1f %%, was %.1f %%",
                  100 * summary["paths"][0]["error"].get<double>(),
                  100 * summary["paths"][0]["error_before"].get<double>());
  else if (summary.contains("probes"))
    std::snprintf(text, sizeof(text), "gain %.2f", summary["probes"][0]["gain"].get<double>());
  return text;
}

Json rowOfDesign(const Example& example) {
  const scene::Scene scene =
      scene::Scene::load(std::string(PLIANT_SOURCE_DIR "/scenes/harmonic/") + example.file + ".json");
  const auto study = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "design");
  base::ExecutionContext context;
  const auto result = std::dynamic_pointer_cast<const scene::DesignResult>(study->run(context));
  const Json summary = result->summary();
  Json row;
  row["area"] = "design";
  row["name"] = std::string("design/") + example.name;
  row["seconds"] = result->seconds;
  row["iterations"] = summary["iterations"];
  row["unavoidable_seconds"] = result->design.cost.seconds();
  row["thesis_seconds"] = example.seconds;
  row["size"] = summary.value("free_coordinates", 0) * (2 * result->harmonics + 1);
  row["termination"] = base::toString(result->termination);
  std::printf("%-18s %5d %5d %3d %3d %4d %4d %4d %4d %4d %4d %6d %8.1f s %8.2f s %6.0f  %s, %s\n",
              row["name"].get<std::string>().c_str(), example.freedoms, summary.value("free_coordinates", 0),
              example.harmonics, result->harmonics, example.samples, result->samples, example.parameters,
              static_cast<int>(result->parameters.size()), example.iterations, summary["iterations"].get<int>(),
              result->design.solves, example.seconds, result->seconds, example.seconds / result->seconds,
              reached(summary).c_str(), row["termination"].get<std::string>().c_str());
  std::fflush(stdout);
  return row;
}

/// What exploring a design by hand costs (2.4.4): the motion, its sensitivities, and how far they can be trusted.
Json rowOfPredictions(const Example& example) {
  const scene::Scene scene =
      scene::Scene::load(std::string(PLIANT_SOURCE_DIR "/scenes/harmonic/") + example.file + ".json");
  const Json& studies = scene.normalized()["studies"];
  const auto design = std::find_if(studies.begin(), studies.end(), [](const Json& s) { return s["type"] == "design"; });
  harmonic::HarmonicBalanceProblem problem(
      scene::buildModel(scene), math::HarmonicBasis((*design)["harmonics"], (*design)["samples"]));
  const auto count = static_cast<int>(problem.model().parameters.size());
  base::ExecutionContext context;
  const harmonic::PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, (*design)["frequency"], {}, context);
  base::Stopwatch watch;
  const harmonic::ResponseSensitivity sensitivity(problem, motion);
  const double first = watch.seconds();
  watch = {};
  const harmonic::PredictionError error(problem, motion, sensitivity);
  const double preparation = watch.seconds();
  watch = {};
  for (int i = 0; i < count; ++i) error.estimate(mechanics::Vector::Unit(count, i));
  const double estimate = watch.seconds() / count;
  watch = {};
  for (int i = 0; i < count; ++i) error.trustedRange(i, 0.05);
  const double range = watch.seconds() / count;
  std::printf(
      "%-18s motion %.0f ms, sensitivity to %d parameters %.0f ms, error of predictions %.0f ms once, %.0f ms a "
      "direction, trusted range %.0f ms a parameter\n",
      example.name, 1e3 * motion.report.seconds, count, 1e3 * first, 1e3 * preparation, 1e3 * estimate, 1e3 * range);
  std::fflush(stdout);
  Json row;
  row["area"] = "design";
  row["name"] = std::string("prediction/") + example.name;
  row["seconds"] = first + preparation + range * count;
  row["size"] = problem.size();
  row["termination"] = base::toString(motion.report.termination);
  return row;
}

}  // namespace

Json measureDesign() {
  std::printf("Thesis Table 2.1 and Pliant: degrees of freedom, harmonics, samples, parameters, iterations, time\n");
  std::printf("%-18s %5s %5s %3s %3s %4s %4s %4s %4s %4s %4s %6s %10s %10s %6s\n", "name", "N_DoF", "ours", "N_H", "",
              "N_AF", "", "N_p", "", "N_it", "", "solves", "thesis", "ours", "ratio");
  Json rows = Json::array();
  for (const Example& example : examples) rows.push_back(rowOfDesign(example));
  rows.push_back(rowOfPredictions(examples[0]));
  return rows;
}

}  // namespace pliant::bench
