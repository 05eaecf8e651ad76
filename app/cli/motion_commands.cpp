#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <limits>
#include <numbers>
#include <optional>

#include "app/cli/commands.hpp"
#include "core/base/error.hpp"
#include "core/scene/cloth_result.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/result_charts.hpp"
#include "core/scene/study.hpp"
#ifdef PLIANT_HAS_RENDERER
#include "app/cli/picture_size.hpp"
#include "ui/render/chart_picture.hpp"
#include "ui/render/image.hpp"
#include "ui/render/offscreen.hpp"
#endif

namespace pliant::cli {

using base::InputError;

namespace {

/// A model at one time of a motion; `problem` is null for the rest shape.
struct Moment {
  std::shared_ptr<const mechanics::Model> model;
  std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem;
  mechanics::Vector z;
  double tau = 0;
  std::string caption;
  std::shared_ptr<const scene::ClothResult> cloth;  ///< or null
  std::shared_ptr<const scene::ClothFrame> frame;   ///< of the cloth
};

/// Empty if there is no result.
std::string kindOfResult(const std::filesystem::path& folder) {
  const auto summary = folder / "summary.json";
  if (!std::filesystem::exists(summary)) return {};
  return scene::parseJson(scene::readTextFile(summary)).value("kind", "");
}

std::string studyWithResult(const scene::Scene& scene, const MotionOptions& options) {
  if (!options.study.empty()) return options.study;
  for (const std::string& name : scene::studyNames(scene)) {
    const std::string kind = kindOfResult(std::filesystem::path(options.result) / name);
    if (kind == "harmonic" || kind == "cloth") return name;
  }
  throw InputError(options.result, "This folder has no result with motions of any study of the scene.");
}

/// The point of a curve where the probes together swing widest.
const harmonic::ResponsePoint& widestSwing(const scene::HarmonicResult& result) {
  const auto swing = [](const harmonic::ResponsePoint& point) {
    double sum = 0;
    for (const auto& amplitude : point.amplitudes) sum += amplitude.pathLength;
    return sum;
  };
  const harmonic::ResponsePoint* widest = &result.points.front();
  for (const harmonic::ResponsePoint& point : result.points)
    if (swing(point) > swing(*widest)) widest = &point;
  return *widest;
}

void warnOfChange(const scene::Scene& scene, const scene::Result& result, const std::filesystem::path& folder) {
  if (result.provenance.sceneHash != scene::hashScene(scene))
    std::cerr << folder.string() << ": The scene has changed since this was computed; what has no slider is drawn as "
              << "the scene has it now.\n";
}

/// The frame nearest to `time`, as a model that rests there.
void takeClothFrame(const scene::Scene& scene, const std::filesystem::path& folder, double time, Moment& moment) {
  auto result = scene::ClothResult::read(scene, folder);
  if (result->frames.empty()) throw InputError(folder.string(), "This result has no frames.");
  warnOfChange(scene, *result, folder);
  moment.frame = result->frameAt(time);
  const scene::ClothFrame& frame = *moment.frame;
  auto model = std::make_shared<mechanics::Model>(*result->problem->model);
  model->restPositions = frame.positions.reshaped();
  moment.model = std::move(model);
  moment.caption +=
      (moment.caption.empty() ? "" : "\n") + result->provenance.study +
      (result->studyType() == "cloth_motion" ? ", t = " + base::formatQuantity(frame.time, base::dimensions::time)
                                             : std::string());
  moment.cloth = std::move(result);
}

Moment findMoment(const MotionOptions& options) {
  const auto scene = scene::Scene::load(options.scene);
  Moment moment;
  moment.caption = scene.normalized()["title"];
  std::optional<double> time;
  try {
    if (!options.time.empty()) time = base::parseQuantity(options.time, base::dimensions::time);
  } catch (const InputError& error) {
    throw InputError("--time", error.problem());
  }
  if (options.result.empty()) {
    moment.model = scene::buildModel(scene);
    return moment;
  }
  const std::string study = studyWithResult(scene, options);
  const auto folder = std::filesystem::path(options.result) / study;
  if (kindOfResult(folder) == "cloth") {
    takeClothFrame(scene, folder, time.value_or(std::numeric_limits<double>::max()), moment);
    return moment;
  }
  const auto result = scene::HarmonicResult::read(scene, folder);
  if (result->points.empty()) throw InputError(folder.string(), "This result has no motion.");
  warnOfChange(scene, *result, folder);
  const harmonic::ResponsePoint& point = widestSwing(*result);
  moment.model = result->problem->sharedModel();
  moment.problem = result->problemOf(point);
  moment.z = point.z;
  moment.tau = std::fmod(point.omega / point.drivePeriods * time.value_or(0), 2 * std::numbers::pi);
  moment.caption += (moment.caption.empty() ? "" : "\n") + study +
                    ", ω = " + base::formatQuantity(point.omega, base::dimensions::angularFrequency) +
                    ", H = " + std::to_string(result->problem->basis().harmonics()) + ", residual " +
                    base::formatQuantity(point.residual, {});
  if (result->termination != base::TerminationType::converged)
    moment.caption += " (" + std::string(base::toString(result->termination)) + ")";
  return moment;
}

}  // namespace

ExitStatus exportMesh(const MotionOptions& options) {
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

#ifdef PLIANT_HAS_RENDERER

render::PictureOptions pictureOf(const std::string& size) {
  render::PictureOptions picture;
  int used = 0;
  if (std::sscanf(size.c_str(), "%5dx%5d%n", &picture.width, &picture.height, &used) != 2 ||
      static_cast<std::size_t>(used) != size.size())
    throw InputError("--size", "Expected WIDTHxHEIGHT, such as 1280x720, found " + scene::quote(size) + ".");
  return picture;
}

ExitStatus render(const MotionOptions& options, const std::string& size) {
  render::PictureOptions picture = pictureOf(size);
  const Moment moment = findMoment(options);
  picture.caption = moment.caption;
  if (moment.model->dimension < 3) picture.view = render::AxisView::top;  // as in the window
  if (moment.cloth)
    render::writePng(render::renderToImage(moment.cloth->problem, {moment.frame}, picture), options.out);
  else
    render::renderToPng(moment.model, moment.problem, moment.z, moment.tau, picture, options.out);
  std::cout << options.out << ": " << picture.width << " x " << picture.height << " pixels\n";
  return done;
}

ExitStatus plot(const PlotOptions& options, const std::string& size) {
  const render::PictureOptions picture = pictureOf(size);
  const auto scene = scene::Scene::load(options.scene);
  auto charts = scene::resultCharts(scene, options.result, options.studies, options.quantity);
  for (scene::ResultChart& chart : charts) chart.logarithmicY |= options.logarithmic;
  render::drawCharts(charts, picture.width, picture.height, picture.theme, options.out);
  std::cout << options.out << ": " << picture.width << " x " << picture.height << " pixels\n";
  return done;
}

#else

ExitStatus render(const MotionOptions&, const std::string&) {
  throw InputError("render", "This build of pliant-cli has no renderer; build with PLIANT_BUILD_UI.");
}

ExitStatus plot(const PlotOptions&, const std::string&) {
  throw InputError("plot", "This build of pliant-cli has no renderer; build with PLIANT_BUILD_UI.");
}

#endif

}  // namespace pliant::cli
