#include "app/cli/interlock_pictures.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/interlock/holding_contacts.hpp"
#include "core/scene/boundary_surface.hpp"
#include "core/scene/interlock_reading.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/polar_curves.hpp"
#ifdef PLIANT_HAS_RENDERER
#include "app/cli/picture_size.hpp"
#include "ui/render/boundary_picture.hpp"
#include "ui/render/polar_curves_picture.hpp"
#endif

namespace pliant::cli {

using base::InputError;
using scene::Json;

namespace {

/// A study's result in a folder that `run` wrote, if it is one of an interlocking material.
struct InterlockFolder {
  std::string study;
  std::filesystem::path folder;
  Json summary;
  std::string type() const { return summary.value("type", ""); }
};

std::optional<InterlockFolder> interlockFolder(const std::filesystem::path& result, const std::string& study) {
  InterlockFolder found{study, result / study, {}};
  if (study.empty() || !std::filesystem::exists(found.folder / "summary.json")) return std::nullopt;
  found.summary = scene::parseJson(scene::readTextFile(found.folder / "summary.json"));
  if (found.summary.value("kind", "") != "interlock") return std::nullopt;
  return found;
}

/// The study asked for, else, where no study of the scene has a motion, the first one that has such a result.
std::optional<InterlockFolder> findInterlock(const scene::Scene& scene, const MotionOptions& options) {
  if (options.result.empty()) return std::nullopt;
  if (!options.study.empty()) return interlockFolder(options.result, options.study);
  std::optional<InterlockFolder> first;
  for (const std::string& name : scene::studyNames(scene)) {
    const auto summary = std::filesystem::path(options.result) / name / "summary.json";
    if (!std::filesystem::exists(summary)) continue;
    const std::string kind = scene::parseJson(scene::readTextFile(summary)).value("kind", "");
    if (kind == "harmonic" || kind == "cloth") return std::nullopt;
    if (!first) first = interlockFolder(options.result, name);
  }
  return first;
}

void warnOfChange(const scene::Scene& scene, const InterlockFolder& found) {
  const Json from = found.summary.value("provenance", Json::object());
  if (from.value("scene_hash", "") != scene::hashScene(scene))
    std::cerr << found.folder.string() << ": The scene has changed since this was computed.\n";
}

}  // namespace

std::optional<ExitStatus> exportBoundary(const MotionOptions& options) {
  const auto scene = scene::Scene::load(options.scene);
  const auto found = findInterlock(scene, options);
  if (!found || found->type() != "stretch_boundary") return std::nullopt;
  warnOfChange(scene, *found);
  const scene::BoundarySurface surface = scene::readBoundarySurface(found->folder);
  geometry::SurfaceMesh mesh;
  mesh.points = surface.points;
  mesh.triangles = surface.triangles;
  geometry::writeMesh(mesh, options.out);
  std::cout << options.out << ": " << surface.knownCount() << " limits, " << mesh.triangles.size()
            << " triangles, in Green strain\n";
  return done;
}

#ifdef PLIANT_HAS_RENDERER

namespace {

/// "E_xy=2 %" or "E_x=0.02".
void readSlice(const std::string& text, render::BoundaryStyle& style) {
  const std::size_t equals = text.find('=');
  const std::string axis = text.substr(0, equals);
  const std::vector<std::string> names{"E_x", "E_y", "E_xy"};
  const auto name = std::find(names.begin(), names.end(), axis);
  if (equals == std::string::npos || name == names.end())
    throw InputError("--slice", "Expected E_x, E_y or E_xy, = and a strain, such as E_xy=0.02 or \"E_xy=2 %\".");
  style.sliceAxis = static_cast<int>(name - names.begin());
  try {
    style.slicePosition = base::parseQuantity(text.substr(equals + 1), {});
  } catch (const InputError& error) {
    throw InputError("--slice", error.problem());
  }
}

std::string percentText(double strain) { return base::formatQuantity(100 * strain, {}) + " %"; }

render::Image boundaryImage(const InterlockFolder& found, const BoundaryLook& look, render::PictureOptions picture) {
  render::BoundaryScenery scenery;
  const auto surface = std::make_shared<scene::BoundarySurface>(scene::readBoundarySurface(found.folder));
  scenery.surface = surface;
  if (!look.compare.empty())
    scenery.compared = std::make_shared<scene::BoundarySurface>(scene::readBoundarySurface(look.compare));
  if (!look.quantity.empty() && !surface->quantity(look.quantity)) {
    std::string names;
    for (const scene::BoundaryQuantity& each : surface->quantities) names += (names.empty() ? "" : ", ") + each.key;
    throw InputError("--colour", "There is no quantity " + scene::quote(look.quantity) + "; there are: " + names + ".");
  }
  if (!look.quantity.empty()) scenery.style.quantity = look.quantity;
  scenery.style.opacity = look.opacity;
  if (!look.slice.empty()) readSlice(look.slice, scenery.style);
  picture.caption += '\n' + found.study + ",  " + std::to_string(surface->knownCount()) + " limits";
  if (scenery.compared) picture.caption += "\nover it, in orange: " + scenery.compared->name;
  return render::drawBoundary(scenery, picture);
}

render::Image limitImage(const scene::Scene& scene, const InterlockFolder& found, render::PictureOptions picture) {
  const auto result = scene::readCellTest(scene, found.folder);
  const interlock::CellEquilibrium& rest = result->limit.equilibrium;
  const double radius = result->cell->smallestRadius();
  auto configuration = std::make_shared<render::CellConfiguration>();
  configuration->cell = result->cell;
  configuration->state = rest.state;
  configuration->contacts = interlock::distinctContacts(rest.contacts, 0.5 * radius);
  picture.caption += '\n' + found.study + ": " + percentText(result->limit.strain) + " at " +
                     base::formatQuantity(result->limit.angle * 180 / std::numbers::pi, {}) + "°, held at " +
                     std::to_string(configuration->contacts.size()) + " places of a cell, mean gap " +
                     base::formatQuantity(rest.meanGap / radius, {}) + " wire radii";
  return render::drawConfiguration(configuration, picture);
}

}  // namespace

std::optional<ExitStatus> renderInterlock(const MotionOptions& options, const BoundaryLook& look,
                                          const std::string& size) {
  render::PictureOptions picture = pictureOf(size);
  const auto scene = scene::Scene::load(options.scene);
  const auto found = findInterlock(scene, options);
  if (!found) return std::nullopt;
  if (!options.time.empty()) throw InputError("--time", "A limit has no time.");
  warnOfChange(scene, *found);
  picture.caption = scene.normalized()["title"];
  const std::string type = found->type();
  if (type == "stretch_boundary")
    render::writePng(boundaryImage(*found, look, picture), options.out);
  else if (type == "cell_test")
    render::writePng(limitImage(scene, *found, picture), options.out);
  else if (type == "free_travel")
    render::writePng(render::drawPolarCurves({scene::freeTravelCurves(*scene::readFreeTravel(scene, found->folder))},
                                             picture.width, picture.height, picture.theme),
                     options.out);
  else
    throw InputError(found->folder.string(), "There is no picture of a result of the type " + scene::quote(type) + ".");
  std::cout << options.out << ": " << picture.width << " x " << picture.height << " pixels\n";
  return done;
}

std::optional<ExitStatus> plotInterlock(const PlotOptions& options, const std::string& size) {
  const render::PictureOptions picture = pictureOf(size);
  const auto scene = scene::Scene::load(options.scene);
  std::vector<scene::PolarCurves> plots;
  for (const std::string& name : options.studies.empty() ? scene::studyNames(scene) : options.studies) {
    const auto found = interlockFolder(options.result, name);
    if (!found && std::filesystem::exists(std::filesystem::path(options.result) / name / "summary.json"))
      return std::nullopt;  // charts of other results
    if (!found || found->type() != "free_travel") continue;
    warnOfChange(scene, *found);
    plots.push_back(scene::freeTravelCurves(*scene::readFreeTravel(scene, found->folder)));
  }
  if (plots.empty()) return std::nullopt;
  render::writePng(render::drawPolarCurves(plots, picture.width, picture.height, picture.theme), options.out);
  std::cout << options.out << ": " << picture.width << " x " << picture.height << " pixels\n";
  return done;
}

#endif

}  // namespace pliant::cli
