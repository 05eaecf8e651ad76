#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>

#include "app/cli/commands.hpp"
#include "app/cli/progress_display.hpp"
#include "app/cli/run_summary.hpp"
#include "app/cli/shards.hpp"
#include "core/base/error.hpp"
#include "core/math/parallel.hpp"
#include "core/scene/expected_values.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/result_folder.hpp"
#include "core/scene/study.hpp"

namespace pliant::cli {

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

/// The scene and those of its studies that are asked for.
struct Work {
  explicit Work(const RunOptions& options)
      : scene(applySettings(scene::Scene::load(options.scene), options.settings)),
        model(scene::buildModel(scene)),
        names(options.studies.empty() ? scene::studyNames(scene) : options.studies) {
    math::setThreadCount(options.threads);
    if (names.empty()) throw base::InputError(scene.name() + ": /studies", "The scene has no studies to run.");
  }
  void makeStudies() {
    for (const std::string& name : names) studies.push_back(scene::StudyRegistry::instance().make(scene, model, name));
  }

  scene::Scene scene;
  std::shared_ptr<const mechanics::Model> model;
  std::vector<std::string> names;
  std::vector<std::unique_ptr<scene::Study>> studies;
};

/// Does something with each study, under a progress display and until Ctrl-C. `act` gets the number of the study and
/// the display.
ExitStatus forEachStudy(
    const Work& work,
    const std::function<base::TerminationType(std::size_t, base::ExecutionContext&, ProgressDisplay&)>& act) {
  ProgressDisplay display;
  std::string current;
  base::ExecutionContext context(
      [&](double fraction, const std::string& message) {
        display.show(fraction, message.empty() ? current : current + ": " + message);
      },
      [&](base::Severity severity, const std::string& message) { display.log(severity, message); });
  const CancelOnInterrupt interrupt(context);
  ExitStatus status = done;
  for (std::size_t i = 0; i < work.studies.size() && !context.cancelRequested(); ++i) {
    current = work.names[i];
    const auto count = static_cast<double>(work.studies.size());
    context.setRange(static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
    const base::TerminationType termination = act(i, context, display);
    if (termination == base::TerminationType::cancelled)
      status = cancelled;
    else if (termination != base::TerminationType::converged && status == done)
      status = notConverged;
  }
  return context.cancelRequested() ? cancelled : status;
}

/// Computes the result of each study, writes it and says what it is.
ExitStatus writeResults(
    const Work& work, const RunOptions& options,
    const std::function<std::shared_ptr<const scene::Result>(const scene::Study&, base::ExecutionContext&)>& compute) {
  for (const std::string& name : work.names)
    scene::ResultFolder writable(std::filesystem::path(options.out) / name);  // refuses before anything is computed
  return forEachStudy(work, [&](std::size_t i, base::ExecutionContext& context, ProgressDisplay& display) {
    const auto result = compute(*work.studies[i], context);
    const std::filesystem::path folder = std::filesystem::path(options.out) / work.names[i];
    result->write(folder);
    display.clear();
    const Json summary = result->summary();
    printSummary(summary);
    if (options.settings.empty()) printExpected(scene::compareWithExpected(work.scene, work.names[i], summary));
    std::cout << "  written to " << folder.string() << std::endl;
    return result->termination;
  });
}

}  // namespace

ExitStatus run(const RunOptions& options) {
  Work work(options);
  work.makeStudies();
  const ExitStatus status = writeResults(
      work, options, [](const scene::Study& study, base::ExecutionContext& context) { return study.run(context); });
  if (!options.plot.empty() && status != cancelled) {
    PlotOptions plotted;
    plotted.scene = options.scene;
    plotted.result = options.out;
    plotted.studies = options.studies;
    plotted.out = options.plot;
    plot(plotted, "1280x720");
  }
  return status;
}

ExitStatus runShard(const RunOptions& options, const std::string& text) {
  const base::Shard shard = shardOf(text);
  Work work(options);
  work.makeStudies();
  for (const auto& study : work.studies) sharded(*study);
  return forEachStudy(work, [&](std::size_t i, base::ExecutionContext& context, ProgressDisplay& display) {
    const std::filesystem::path file = shardFile(options.out, work.names[i], shard);
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (error)
      throw base::InputError(file.parent_path().string(), "The folder cannot be made: " + error.message() + ".");
    const base::TerminationType termination = sharded(*work.studies[i]).runShard(shard, file, context);
    display.clear();
    std::cout << work.names[i] << ": shard " << text << " " << base::toString(termination) << "\n  kept in "
              << file.string() << std::endl;
    return termination;
  });
}

ExitStatus mergeShards(const RunOptions& options) {
  Work work(options);
  if (options.studies.empty()) {
    std::erase_if(work.names, [&](const std::string& name) { return !hasShards(options.out, name); });
    if (work.names.empty())
      throw base::InputError(options.out, "There are no shards of this scene; compute them with `run --shard` first.");
  }
  work.makeStudies();
  std::vector<std::vector<std::filesystem::path>> files;
  for (const std::string& name : work.names) files.push_back(allShardFiles(options.out, name));
  std::size_t next = 0;
  return writeResults(work, options, [&](const scene::Study& study, base::ExecutionContext& context) {
    return sharded(study).merge(files[next++], context);
  });
}

}  // namespace pliant::cli
