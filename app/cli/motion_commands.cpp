#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "app/cli/interlock_pictures.hpp"
#include "app/cli/moment.hpp"
#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/motion_animation.hpp"
#include "core/scene/result_charts.hpp"
#ifdef PLIANT_HAS_RENDERER
#include "app/cli/picture_size.hpp"
#include "ui/render/chart_picture.hpp"
#include "ui/render/image.hpp"
#include "ui/render/offscreen.hpp"
#endif

namespace pliant::cli {

using base::InputError;

ExitStatus exportMesh(const MotionOptions& options) {
  if (const auto status = exportBoundary(options)) return *status;
  const Moment moment = findMoment(options);
  const mechanics::Vector positions =
      moment.problem ? moment.problem->configurationAt(moment.z, moment.tau) : moment.model->restPositions;
  const geometry::SurfaceMesh mesh = scene::surfaceAt(*moment.model, positions);
  if (mesh.triangles.empty()) throw InputError(options.scene, "The scene has no triangles to export.");
  geometry::writeMesh(mesh, options.out);
  std::cout << options.out << ": " << moment.model->nodeCount() << " nodes, " << mesh.triangles.size()
            << " triangles\n";
  return done;
}

ExitStatus exportAnimation(const MotionOptions& options, const FilmSettings& settings) {
  constexpr double secondsPerPeriod = 2;  // as in videos
  if (std::filesystem::path(options.out).extension() != ".glb")
    throw InputError("--out", "An animation's file must end in .glb, found " + scene::quote(options.out) + ".");
  if (!options.time.empty()) throw InputError("--time", "An animation shows all of a motion.");
  if (options.result.empty()) throw InputError("--result", "An animation needs the folder that `run` wrote.");
  const Moment moment = findMoment(options);
  base::ExecutionContext context;
  geometry::MeshAnimation animation;
  if (moment.cloth) {
    animation = *scene::clothAnimation(*moment.cloth->problem, moment.cloth->frames, context);
    for (double& time : animation.times) time /= settings.speed.value_or(1);
  } else {
    const double seconds =
        settings.speed ? moment.period / *settings.speed : secondsPerPeriod * moment.problem->basis().periods();
    const int steps = settings.picturesPerSecond
                          ? std::max(1, static_cast<int>(std::lround(*settings.picturesPerSecond * seconds)))
                          : scene::animationSteps(seconds);
    animation = scene::periodAnimation(*moment.problem, moment.z, steps, seconds);
  }
  geometry::writeAnimation(animation, options.out);
  std::cout << options.out << ": " << animation.frames.size() << " frames of " << animation.triangles.size()
            << " triangles, " << base::formatQuantity(animation.times.back(), base::dimensions::time) << "\n";
  return done;
}

#ifdef PLIANT_HAS_RENDERER

render::PictureOptions pictureOf(const std::string& size) {
  render::PictureOptions picture;
  int used = 0;
  if (std::sscanf(size.c_str(), "%5dx%5d%n", &picture.width, &picture.height, &used) != 2 ||
      static_cast<std::size_t>(used) != size.size())
    throw InputError("--size", "Expected WIDTHxHEIGHT, such as 1280x720, found " + scene::quote(size) + ".");
  return picture;
}

ExitStatus render(const MotionOptions& options, const BoundaryLook& look, const std::string& size) {
  if (const auto status = renderInterlock(options, look, size)) return *status;
  render::PictureOptions picture = pictureOf(size);
  const Moment moment = findMoment(options);
  picture.caption = moment.caption + moment.instant;
  if (moment.model->dimension < 3) picture.view = render::AxisView::top;  // as in the window
  if (moment.cloth)
    render::writePng(render::renderToImage(moment.cloth->problem, {moment.frame}, picture), options.out);
  else
    render::renderToPng(moment.model, moment.problem, moment.z, moment.tau, picture, options.out);
  std::cout << options.out << ": " << picture.width << " x " << picture.height << " pixels\n";
  return done;
}

ExitStatus plot(const PlotOptions& options, const std::string& size) {
  if (const auto status = plotInterlock(options, size)) return *status;
  const render::PictureOptions picture = pictureOf(size);
  const auto scene = scene::Scene::load(options.scene);
  auto charts = scene::resultCharts(scene, options.result, options.studies, options.quantity);
  for (scene::ResultChart& chart : charts) chart.logarithmicY |= options.logarithmic;
  render::drawCharts(charts, picture.width, picture.height, picture.theme, options.out);
  std::cout << options.out << ": " << picture.width << " x " << picture.height << " pixels\n";
  return done;
}

#else

ExitStatus render(const MotionOptions&, const BoundaryLook&, const std::string&) {
  throw InputError("render", "This build of pliant-cli has no renderer; build with PLIANT_BUILD_UI.");
}

ExitStatus plot(const PlotOptions&, const std::string&) {
  throw InputError("plot", "This build of pliant-cli has no renderer; build with PLIANT_BUILD_UI.");
}

#endif

}  // namespace pliant::cli
