#include "app/cli/moment.hpp"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <numbers>
#include <optional>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"

namespace pliant::cli {

using base::InputError;

namespace {

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
  moment.caption += (moment.caption.empty() ? "" : "\n") + result->provenance.study;
  if (result->studyType() == "cloth_motion")
    moment.instant = ", t = " + base::formatQuantity(frame.time, base::dimensions::time);
  moment.cloth = std::move(result);
}

}  // namespace

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
  moment.period = 2 * std::numbers::pi * point.drivePeriods / point.omega;
  moment.tau = 2 * std::numbers::pi * std::fmod(time.value_or(0) / moment.period, 1);
  const math::HarmonicBasis& basis = moment.problem->basis();
  moment.caption += (moment.caption.empty() ? "" : "\n") + study +
                    ", ω = " + base::formatQuantity(point.omega, base::dimensions::angularFrequency) +
                    (basis.hasTwoFrequencies() ? " and " + base::formatQuantity(basis.ratio() * point.omega,
                                                                                base::dimensions::angularFrequency)
                                               : std::string()) +
                    ", H = " + std::to_string(basis.order()) + ", residual " + base::formatQuantity(point.residual, {});
  if (result->termination != base::TerminationType::converged)
    moment.caption += " (" + std::string(base::toString(result->termination)) + ")";
  return moment;
}

}  // namespace pliant::cli
