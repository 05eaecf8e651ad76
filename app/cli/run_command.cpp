#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>

#include "app/cli/commands.hpp"
#include "app/cli/progress_display.hpp"
#include "core/base/error.hpp"
#include "core/math/parallel.hpp"
#include "core/scene/expected_values.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/result_folder.hpp"
#include "core/scene/study.hpp"

namespace pliant::cli {

namespace dimensions = base::dimensions;
using scene::Json;

namespace {

/// The scene with "/json/pointer=VALUE" applied; VALUE is JSON, or a text where it is none.
scene::Scene applySetting(const scene::Scene& scene, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || setting.empty() || setting.front() != '/')
    throw base::InputError("--set " + setting, "Expected /json/pointer=VALUE.");
  const std::string text = setting.substr(equals + 1);
  const Json value = Json::parse(text, nullptr, false);
  return scene.withValue(setting.substr(0, equals), value.is_discarded() ? Json(text) : value);
}

std::string length(const Json& value) { return base::formatQuantity(value.get<double>(), dimensions::length); }

std::string frequency(const Json& entry) {
  return base::formatQuantity(entry["frequency"].get<double>(), dimensions::angularFrequency) + " (" +
         base::formatQuantity(entry["frequency_hz"].get<double>(), {}) + " Hz)";
}

/// All settings applied, in any order that the scene allows: more harmonics may need more samples first.
scene::Scene applySettings(scene::Scene scene, std::vector<std::string> settings) {
  while (!settings.empty()) {
    std::vector<std::string> refused;
    std::exception_ptr reason;
    for (const std::string& setting : settings) {
      try {
        scene = applySetting(scene, setting);
      } catch (const base::InputError&) {
        refused.push_back(setting);
        if (!reason) reason = std::current_exception();
      }
    }
    if (refused.size() == settings.size()) std::rethrow_exception(reason);
    settings = std::move(refused);
  }
  return scene;
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

}  // namespace

ExitStatus run(const RunOptions& options) {
  math::setThreadCount(options.threads);
  const scene::Scene scene = applySettings(scene::Scene::load(options.scene), options.settings);
  const auto model = scene::buildModel(scene);
  const std::vector<std::string> names = options.studies.empty() ? scene::studyNames(scene) : options.studies;
  if (names.empty()) throw base::InputError(scene.name() + ": /studies", "The scene has no studies to run.");

  std::vector<std::unique_ptr<scene::Study>> studies;
  for (const std::string& name : names) {
    studies.push_back(scene::StudyRegistry::instance().make(scene, model, name));
    scene::ResultFolder writable(std::filesystem::path(options.out) / name);  // refuses before anything is computed
  }

  ProgressDisplay display;
  std::string current;
  base::ExecutionContext context(
      [&](double fraction, const std::string& message) {
        display.show(fraction, message.empty() ? current : current + ": " + message);
      },
      [&](base::Severity severity, const std::string& message) { display.log(severity, message); });
  const CancelOnInterrupt interrupt(context);
  ExitStatus status = done;
  for (std::size_t i = 0; i < studies.size() && !context.cancelRequested(); ++i) {
    current = names[i];
    const auto count = static_cast<double>(studies.size());
    context.setRange(static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
    const auto result = studies[i]->run(context);
    const std::filesystem::path folder = std::filesystem::path(options.out) / names[i];
    result->write(folder);
    display.clear();
    const Json summary = result->summary();
    printSummary(summary);
    if (options.settings.empty()) printExpected(scene::compareWithExpected(scene, names[i], summary));
    std::cout << "  written to " << folder.string() << std::endl;
    if (result->termination == base::TerminationType::cancelled)
      status = cancelled;
    else if (result->termination != base::TerminationType::converged && status == done)
      status = notConverged;
  }
  if (!options.plot.empty() && !context.cancelRequested()) {
    PlotOptions plotted;
    plotted.scene = options.scene;
    plotted.result = options.out;
    plotted.studies = options.studies;
    plotted.out = options.plot;
    plot(plotted, "1280x720");
  }
  return context.cancelRequested() ? cancelled : status;
}

}  // namespace pliant::cli
