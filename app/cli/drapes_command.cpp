#include <algorithm>
#include <iostream>

#include "app/cli/commands.hpp"
#include "app/cli/progress_display.hpp"
#include "core/base/error.hpp"
#include "core/scene/cloth_result.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"
#ifdef PLIANT_HAS_RENDERER
#include "app/cli/picture_size.hpp"
#include "ui/render/drape_figure.hpp"
#endif

namespace pliant::cli {

using base::InputError;

#ifdef PLIANT_HAS_RENDERER

namespace {

/// The first drape, or else the first motion.
std::string drapeStudy(const scene::Scene& scene) {
  for (const char* type : {"cloth_drape", "cloth_motion"})
    for (const scene::Json& study : scene.normalized()["studies"])
      if (study["type"] == type) return study["name"];
  throw InputError(scene.name() + ": /studies", "The scene has no study of the type cloth_drape or cloth_motion.");
}

std::shared_ptr<const scene::ClothResult> computedOrRead(const scene::Scene& scene, const std::string& result,
                                                         base::ExecutionContext& context) {
  const std::string study = drapeStudy(scene);
  if (!result.empty()) return scene::ClothResult::read(scene, std::filesystem::path(result) / study);
  const auto made = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study);
  return std::dynamic_pointer_cast<const scene::ClothResult>(made->run(context));
}

}  // namespace

ExitStatus drapes(const DrapesOptions& options, const std::string& size) {
  const render::PictureOptions picture = pictureOf(size);
  if (!options.results.empty() && options.results.size() != options.scenes.size())
    throw InputError("--result", "Expected one folder for each of the " + std::to_string(options.scenes.size()) +
                                     " scenes, found " + std::to_string(options.results.size()) + ".");
  std::vector<scene::Scene> scenes;
  for (const std::string& file : options.scenes) {
    scenes.push_back(scene::Scene::load(file));
    drapeStudy(scenes.back());  // refuses before anything is computed
  }
  ProgressDisplay display;
  std::string current;
  base::ExecutionContext context(
      [&](double fraction, const std::string&) { display.show(fraction, current); },
      [&](base::Severity severity, const std::string& message) { display.log(severity, message); });
  const CancelOnInterrupt interrupt(context);
  ExitStatus status = done;
  std::vector<render::Drape> drawn;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    current = scenes[i].normalized()["title"];
    const auto count = static_cast<double>(scenes.size());
    context.setRange(static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
    const auto result = computedOrRead(scenes[i], options.results.empty() ? "" : options.results[i], context);
    if (context.cancelRequested()) return cancelled;
    if (result->frames.empty()) throw InputError(scenes[i].name(), "This result has no frames.");
    if (result->termination != base::TerminationType::converged) {
      status = notConverged;
      display.log(base::Severity::warning, scenes[i].name() + ": " + result->message);
    }
    drawn.push_back({current, result->problem, result->frames.back()});
  }
  display.clear();
  const double ratio = render::fittingPixelRatio(drawn.size(), picture.width, picture.height);
  render::writePng(render::drawDrapes(drawn, picture.width, picture.height, ratio, picture.theme), options.out);
  std::cout << options.out << ": " << picture.width << " x " << picture.height << " pixels\n";
  return status;
}

#else

ExitStatus drapes(const DrapesOptions&, const std::string&) {
  throw InputError("drapes", "This build of pliant-cli has no renderer; build with PLIANT_BUILD_UI.");
}

#endif

}  // namespace pliant::cli
