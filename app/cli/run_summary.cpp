#include "app/cli/run_summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "core/base/units.hpp"

namespace pliant::cli {

namespace dimensions = base::dimensions;
using scene::Json;

namespace {

std::string length(const Json& value) { return base::formatQuantity(value.get<double>(), dimensions::length); }

std::string frequency(const Json& entry) {
  return base::formatQuantity(entry["frequency"].get<double>(), dimensions::angularFrequency) + " (" +
         base::formatQuantity(entry["frequency_hz"].get<double>(), {}) + " Hz)";
}

void printProbes(const Json& probes) {
  for (const Json& probe : probes)
    std::cout << "  " << probe["name"].get<std::string>() << ": path length " << length(probe["path_length"])
              << ", maximum displacement " << length(probe["maximum_displacement"]) << "\n";
}

/// How Newton's method converged: corrections that square from one to the next show that the Jacobian is right.
void printIterations(const Json& iterations) {
  std::cout << "  iteration    residual  correction  step\n";
  for (const Json& record : iterations) {
    char line[80];
    std::snprintf(line, sizeof line, "  %9d  %10.2e  %10.2e  %4g\n", record["iteration"].get<int>(),
                  record["residual"].get<double>(), record["correction"].get<double>(),
                  record["step_length"].get<double>());
    std::cout << line;
  }
}

void printHarmonic(const Json& summary) {
  std::cout << "  " << summary["newton_iterations"] << " Newton iterations, residual "
            << base::formatQuantity(summary["residual"].get<double>(), {}) << " of the driving force, last correction "
            << base::formatQuantity(summary["correction"].get<double>(), {}) << " of the swing\n";
  std::cout << "  H = " << summary["harmonics"] << ", N = " << summary["samples"] << ", " << summary["unknowns"]
            << " unknowns\n";
  if (summary.contains("left_out")) {
    const auto harmonics = summary["coordinate_harmonics"].get<std::vector<int>>();
    const auto [fewest, most] = std::minmax_element(harmonics.begin(), harmonics.end());
    std::cout << "  harmonics per node: " << *fewest << " to " << *most
              << "; those left out would move a node by about "
              << base::formatQuantity(summary["left_out"].get<double>(), {}) << " of the longest path\n";
  }
  if (summary.contains("iterations")) printIterations(summary["iterations"]);
  if (summary.contains("probes")) {
    std::cout << "  at " << frequency(summary) << "\n";
    printProbes(summary["probes"]);
  }
  if (!summary.contains("point_count")) return;
  std::cout << "  " << summary["point_count"] << " points\n";
  for (const Json& peak : summary["peaks"]) {
    std::cout << "  peak at " << frequency(peak);
    if (peak.contains("probe"))
      std::cout << ": " << peak["probe"].get<std::string>() << " path length " << length(peak["path_length"])
                << ", maximum displacement " << length(peak["maximum_displacement"]);
    std::cout << "\n";
  }
  for (const Json& fold : summary["folds"]) std::cout << "  fold at " << frequency(fold) << "\n";
}

void printModes(const Json& summary) {
  std::cout << "  mode  frequency [rad/s]        [Hz]  damping ratio  residual\n";
  int number = 0;
  for (const Json& mode : summary["modes"]) {
    char line[80];
    std::snprintf(line, sizeof line, "  %4d  %17.6g  %10.5g  %13.4g  %8.1e\n", ++number,
                  mode["frequency"].get<double>(), mode["frequency_hz"].get<double>(),
                  mode["damping_ratio"].get<double>(), mode["residual"].get<double>());
    std::cout << line;
  }
}

void printTime(const Json& summary) {
  std::cout << "  " << summary["period_count"] << " periods of " << summary["steps_per_period"] << " steps, "
            << summary["newton_iterations"] << " Newton iterations, " << summary["factorizations"]
            << " factorisations\n  last periods differ by e_p = " << length(summary["difference"]) << "\n  at "
            << frequency(summary) << "\n";
  printProbes(summary["probes"]);
}

void printCompared(const char* title, const Json& solutions) {
  std::cout << title << "  to Newmark  to reference   seconds\n";
  for (const Json& solution : solutions) {
    char line[96];
    std::snprintf(line, sizeof line, "  %9d  %7d  %10.2e  %12.2e  %8.3g\n", solution.value("harmonics", 0),
                  solution.contains("steps") ? solution["steps"].get<int>() : solution["samples"].get<int>(),
                  solution.value("relative_difference_to_newmark", NAN),
                  solution.value("relative_difference_to_reference", NAN), solution["seconds"].get<double>());
    std::cout << line;
  }
}

void printComparison(const Json& summary) {
  std::cout << "  at " << frequency(summary) << ", differences relative to the swing\n";
  printCompared("  harmonics  samples", summary["harmonics"]);
  printCompared("  (Newmark)    steps", summary["steps"]);
  printCompared("  harmonics   both N", summary["samples"]);
}

void printCloth(const Json& summary) {
  const auto number = [](const Json& value) {
    return value.is_number() ? base::formatQuantity(value.get<double>(), {}) : std::string("none");
  };
  if (summary.contains("projection")) {
    const Json& projection = summary["projection"];
    std::cout << "  objective " << number(projection["objective"]) << ", bound " << number(projection["bound"])
              << ", relative gap " << number(projection["relative_gap"]) << ", violation "
              << number(projection["violation"]) << ", " << projection["iterations"] << " iterations\n";
    for (const char* key : {"conflicting_triangles", "conflicting_pins"})
      if (!projection[key].empty())
        std::cout << "  " << (key + std::string("conflicting_").size())
                  << " that contradict each other: " << projection[key].dump() << "\n";
  }
  if (summary.value("steps", 0) == 0) return;
  std::cout << "  " << summary["steps"] << " steps, " << summary["newton_iterations"] << " Newton iterations ("
            << base::formatQuantity(summary["newton_seconds_per_step"].get<double>(), dimensions::time) << " a step), "
            << summary["projection_iterations"] << " of projections ("
            << base::formatQuantity(summary["projection_seconds_per_step"].get<double>(), dimensions::time)
            << " a step)\n  violation " << number(summary["violation"]) << ", relative gap "
            << number(summary["relative_gap"]) << ", total energy " << number(summary["energy_start"]["total"])
            << " J after the first step, " << number(summary["energy_end"]["total"]) << " J after the last\n";
  if (summary.contains("residual"))
    std::cout << "  unbalanced force " << number(summary["residual"]) << " of the external force\n";
}

void printInterlock(const Json& summary) {
  const auto percent = [](const Json& value) { return base::formatQuantity(100 * value.get<double>(), {}) + " %"; };
  if (summary.contains("strain"))
    std::cout << "  limit " << percent(summary["strain"]) << ", " << summary["rest"].get<std::string>() << " by "
              << summary["contacts"] << " contacts, smaller gaps could add " << percent(summary["remaining"]) << "\n";
  if (summary.contains("outcome")) {
    std::cout << "  " << summary["outcome"].get<std::string>();
    if (summary["curvature_limit"].is_null())
      std::cout << ", no limit\n";
    else
      std::cout << " at " << base::formatQuantity(summary["curvature_limit"].get<double>(), {}) << " 1/m, across "
                << base::formatQuantity(summary["orthogonal_curvature"].get<double>(), {}) << " 1/m\n";
  }
  for (const char* key : {"stretch", "compression", "free_travel"})
    if (summary.contains(key) && summary[key].contains("smallest"))
      std::cout << "  " << key << " " << percent(summary[key]["smallest"]) << " to " << percent(summary[key]["largest"])
                << "\n";
  if (summary.contains("limits"))
    std::cout << "  " << summary["limits"] << " limits, gaps at most "
              << base::formatQuantity(summary["largest_gap_over_radius"].get<double>(), {}) << " wire radii, "
              << summary["missed_slices"] << " slices locked before their principal strain\n";
  if (summary.contains("states"))
    std::cout << "  " << summary["states"] << " limits, " << (summary["closed"].get<bool>() ? "closed" : "not closed")
              << ", gaps at most " << base::formatQuantity(summary["largest_gap_over_radius"].get<double>(), {})
              << " wire radii, " << summary["raised_by_neighbours"] << " raised by neighbours, "
              << summary["not_star_shaped"] << " not star-shaped\n";
}

void printCalibration(const Json& summary) {
  if (!summary.contains("parameters")) return;
  for (const Json& parameter : summary["parameters"]) {
    const std::string unit = parameter["unit"];
    const auto number = [](const Json& value) { return base::formatQuantity(value.get<double>(), {}); };
    std::cout << "  " << parameter["name"].get<std::string>() << ": " << number(parameter["value"]) << " " << unit;
    if (parameter["lower"].is_number())
      std::cout << ", " << 100 * summary["confidence"].get<double>() << " % interval " << number(parameter["lower"])
                << " to " << number(parameter["upper"]);
    else
      std::cout << ", no interval";
    std::cout << "\n";
  }
  std::cout << "  " << summary["sample_count"] << " values, off by " << length(summary["root_mean_square_before"])
            << " before and " << length(summary["root_mean_square"]) << " after (root mean square)\n";
}

void printConstraints(const Json& summary) {
  if (!summary.contains("constraints")) return;
  const auto number = [](const Json& value) { return base::formatQuantity(value.get<double>(), {}); };
  for (const Json& constraint : summary["constraints"]) {
    std::cout << "  " << constraint["name"].get<std::string>() << ": " << number(constraint["value"]) << " (";
    if (constraint["at_least"].is_number()) std::cout << "at least " << number(constraint["at_least"]);
    if (constraint["at_most"].is_number())
      std::cout << (constraint["at_least"].is_number() ? ", " : "") << "at most " << number(constraint["at_most"]);
    std::cout << "), " << number(constraint["value_before"]) << " before\n";
  }
  std::cout << "  constraints broken by " << number(summary["constraint_violation"])
            << " of a bound, optimality residual " << number(summary["optimality_residual"]) << "\n";
}

}  // namespace

void printSummary(const Json& summary) {
  std::cout << summary["study"].get<std::string>() << ": " << summary["termination"].get<std::string>() << ", "
            << base::formatQuantity(summary["seconds"].get<double>(), dimensions::time) << "\n";
  if (const auto message = summary["message"].get<std::string>(); !message.empty())
    std::cout << "  " << message << "\n";
  const std::string kind = summary["kind"];
  if (kind == "harmonic") printHarmonic(summary);
  if (kind == "modes") printModes(summary);
  if (kind == "time") printTime(summary);
  if (kind == "comparison") printComparison(summary);
  if (kind == "cloth") printCloth(summary);
  if (kind == "interlock") printInterlock(summary);
  if (kind == "calibration") printCalibration(summary);
  if (kind == "design") printConstraints(summary);
}

void printExpected(const std::vector<scene::ExpectedValue>& values) {
  if (values.empty()) return;
  const auto met = std::count_if(values.begin(), values.end(), [](const auto& value) { return value.holds(); });
  std::cout << "  expected values: " << met << " of " << values.size() << " met\n";
  for (const scene::ExpectedValue& value : values)
    if (!value.holds())
      std::cout << "  " << value.pointer << " is " << base::formatQuantityExactly(value.found, {}) << ", expected "
                << base::formatQuantityExactly(value.expected, {}) << "\n";
}

}  // namespace pliant::cli
