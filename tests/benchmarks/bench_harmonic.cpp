#include "tests/benchmarks/bench_harmonic.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/stopwatch.hpp"
#include "core/harmonic/frequency_response.hpp"
#include "core/scene/model_builder.hpp"
#include "tests/benchmarks/bench_scaling.hpp"

namespace pliant::bench {

namespace {

using scene::Json;

struct Run {
  base::SolverReport report;
  int iterations = 0;
};

Run run(harmonic::HarmonicBalanceProblem& problem, const Json& study) {
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions newton;
  newton.tolerance = study["tolerance"];
  if (study["type"] == "periodic_motion") {
    Run result{harmonic::solvePeriodicMotion(problem, study["frequency"], newton, context).report};
    result.iterations = static_cast<int>(result.report.iterations.size()) - 1;
    return result;
  }
  harmonic::FrequencyResponseOptions options;
  options.from = study["from"];
  options.to = study["to"];
  options.newton = newton;
  const auto response = harmonic::traceFrequencyResponse(problem, options, context);
  Run result{response.report};
  for (const auto& point : response.points) result.iterations += point.newtonIterations;
  return result;
}

Json rowOf(const scene::Scene& scene, const std::string& sceneName, const Json& study) {
  harmonic::HarmonicBalanceProblem problem(scene::buildModel(scene), {study["harmonics"], study["samples"]});
  const base::Stopwatch watch;
  const Run result = run(problem, study);
  const double seconds = watch.seconds();
  const harmonic::SolutionCost& cost = problem.cost();
  Json row;
  row["area"] = "harmonic";
  row["name"] = "harmonic/" + sceneName + "/" + study["name"].get<std::string>();
  row["seconds"] = seconds;
  row["iterations"] = result.iterations;
  row["unavoidable_seconds"] = cost.seconds();
  row["thesis_seconds"] = nullptr;
  row["size"] = problem.size();
  row["termination"] = base::toString(result.report.termination);
  std::printf("%-36s %7d %10.3f s %10.3f s %6.2f %6d %5d %6d %6d  %s\n", row["name"].get<std::string>().c_str(),
              static_cast<int>(problem.size()), seconds, cost.seconds(), seconds / cost.seconds(), result.iterations,
              cost.factorizations, cost.evaluations, cost.solves, row["termination"].get<std::string>().c_str());
  std::fflush(stdout);
  return row;
}

}  // namespace

Json measureHarmonic() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(PLIANT_SOURCE_DIR "/scenes/harmonic"))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::printf("%-36s %7s %12s %12s %6s %6s %5s %6s %6s\n", "name", "size", "time", "unavoidable", "ratio", "iter.",
              "LU", "eval.", "solves");
  Json rows = Json::array();
  for (const auto& file : files) {
    const scene::Scene scene = scene::Scene::load(file);
    for (const Json& study : scene.normalized()["studies"])
      if (!study.contains("harmonics_tolerance") &&
          (study["type"] == "periodic_motion" || study["type"] == "frequency_response"))
        rows.push_back(rowOf(scene, file.stem().string(), study));
  }
  measureNewtonIterations(rows);
  return rows;
}

}  // namespace pliant::bench
