#include "app/cli/interlock_pictures.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/pending_file.hpp"
#include "core/base/units.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/interlock/holding_contacts.hpp"
#include "core/scene/bending_chart.hpp"
#include "core/scene/bending_reading.hpp"
#include "core/scene/boundary_surface.hpp"
#include "core/scene/element_design_chart.hpp"
#include "core/scene/interlock_reading.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/macro_reading.hpp"
#include "core/scene/polar_curves.hpp"
#ifdef PLIANT_HAS_RENDERER
#include "app/cli/picture_size.hpp"
#include "ui/render/boundary_picture.hpp"
#include "ui/render/chart_picture.hpp"
#include "ui/render/macro_picture.hpp"
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
  bool isBoundary() const { return type() == "stretch_boundary" || type() == "bending_boundary"; }
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
  if (!found || !found->isBoundary()) return std::nullopt;
  warnOfChange(scene, *found);
  if (std::filesystem::path(options.out).extension() == ".csv") {
    base::writeFile(options.out, scene::readTextFile(found->folder / "boundary.csv"));
    std::cout << options.out << ": " << found->summary["states"] << " limits\n";
    return done;
  }
  const scene::BoundarySurface surface = scene::readBoundarySurface(found->folder);
  geometry::SurfaceMesh mesh;
  mesh.points = surface.points;
  mesh.triangles = surface.triangles;
  geometry::writeMesh(mesh, options.out);
  std::cout << options.out << ": " << surface.knownCount() << " limits, " << mesh.triangles.size() << " triangles, in "
            << (surface.space.unit == "%" ? "Green strain" : "curvature [1/m]") << "\n";
  return done;
}

std::shared_ptr<const scene::MacroResult> findSheetMotion(const MotionOptions& options) {
  const auto scene = scene::Scene::load(options.scene);
  const auto found = findInterlock(scene, options);
  if (!found || (found->type() != "macro_motion" && found->type() != "macro_equilibrium")) return nullptr;
  const auto sheet = scene::readMacro(scene, found->folder);
  if (sheet->frames.empty()) return nullptr;
  warnOfChange(scene, *found);
  return sheet;
}

#ifdef PLIANT_HAS_RENDERER

namespace {

/// "E_xy=2 %" or "E_x=0.02", of bending "k_xy=20 1/m".
void readSlice(const std::string& text, const scene::BoundarySpace& space, render::BoundaryStyle& style) {
  const std::size_t equals = text.find('=');
  const auto& names = space.axes;
  const auto name = std::find(names.begin(), names.end(), text.substr(0, equals));
  const bool bends = space.unit != "%";
  if (equals == std::string::npos || name == names.end())
    throw InputError("--slice", "Expected " + names[0] + ", " + names[1] + " or " + names[2] + ", = and " +
                                    (bends ? "a curvature, such as \"k_xy=20 1/m\"."
                                           : "a strain, such as E_xy=0.02 or \"E_xy=2 %\"."));
  style.sliceAxis = static_cast<int>(name - names.begin());
  try {
    style.slicePosition =
        base::parseQuantity(text.substr(equals + 1), bends ? base::Dimension{0, -1, 0, 0} : base::Dimension{});
  } catch (const InputError& error) {
    throw InputError("--slice", error.problem());
  }
}

std::string percentText(double strain) { return base::formatQuantity(100 * strain, {}) + " %"; }

render::Image boundaryImage(const InterlockFolder& found, const BoundaryLook& look, render::PictureOptions picture) {
  render::BoundaryScenery scenery;
  const auto surface = std::make_shared<scene::BoundarySurface>(scene::readBoundarySurface(found.folder));
  scenery.surface = surface;
  if (!look.compare.empty()) {
    scenery.compared = std::make_shared<scene::BoundarySurface>(scene::readBoundarySurface(look.compare));
    if (scenery.compared->space.unit != surface->space.unit)
      throw InputError("--compare", "Of the two boundaries one is of stretch, the other one of bending.");
  }
  if (!look.quantity.empty() && !surface->quantity(look.quantity)) {
    std::string names;
    for (const scene::BoundaryQuantity& each : surface->quantities) names += (names.empty() ? "" : ", ") + each.key;
    throw InputError("--colour", "There is no quantity " + scene::quote(look.quantity) + "; there are: " + names + ".");
  }
  if (!look.quantity.empty()) scenery.style.quantity = look.quantity;
  scenery.style.opacity = look.opacity;
  if (!look.slice.empty()) readSlice(look.slice, surface->space, scenery.style);
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

template <class AnyResult>
render::Image patchImage(const AnyResult& result, render::PictureOptions picture) {
  const auto configuration = render::patchConfiguration(result);
  if (!configuration) throw InputError(result.provenance.study, "This study ended before elements had places.");
  picture.caption += '\n' + render::patchCaption(result);
  return render::drawPatch(configuration, picture);
}

render::Image macroImage(const scene::Scene& scene, const InterlockFolder& found, const MotionOptions& options,
                         const BoundaryLook& look, render::PictureOptions picture) {
  const auto result = scene::readMacro(scene, found.folder);
  std::optional<double> time;
  if (!options.time.empty()) {
    if (result->frames.empty()) throw InputError("--time", "A sheet at rest has no time.");
    time = base::parseQuantity(options.time, base::dimensions::time);
  }
  picture.caption += '\n' + render::macroCaption(*result);
  return render::drawMacro(result, picture, time, result->placed && look.quantity.empty());
}

/// What of a result is drawn over directions or sizes; neither of most.
struct InterlockPlots {
  std::vector<scene::PolarCurves> polar;
  std::vector<scene::ResultChart> charts;
  bool isEmpty() const { return polar.empty() && charts.empty(); }
};

void addPlots(const scene::Scene& scene, const InterlockFolder& found, InterlockPlots& plots) {
  const std::string type = found.type();
  if (type == "free_travel")
    plots.polar.push_back(scene::freeTravelCurves(*scene::readFreeTravel(scene, found.folder)));
  else if (type == "curvature_limits")
    plots.polar.push_back(scene::curvatureLimitCurves(*scene::readCurvatureLimits(scene, found.folder)));
  else if (type == "element_design") {
    const scene::DesignedLimits design = scene::readDesignedLimits(found.folder);
    const scene::PolarCurves curves = scene::elementDesignCurves(design);
    if (!curves.curves.empty()) plots.polar.push_back(curves);
    plots.charts.push_back(scene::elementDesignChart(design));
  } else if (type == "bending_size")
    plots.charts.push_back(scene::bendingSizeChart(*scene::readBendingSize(scene, found.folder)));
}

/// Polar plots on the left, charts on the right, all of one width.
void drawPlots(const InterlockPlots& plots, const render::PictureOptions& picture, const std::string& out) {
  const auto all = static_cast<int>(plots.polar.size() + plots.charts.size());
  const int left = picture.width * static_cast<int>(plots.polar.size()) / all;
  render::Image image;
  if (left > 0) image = render::drawPolarCurves(plots.polar, left, picture.height, picture.theme);
  if (!plots.charts.empty())
    image =
        render::beside(image, render::chartImage(plots.charts, picture.width - left, picture.height, picture.theme));
  render::writePng(image, out);
  std::cout << out << ": " << picture.width << " x " << picture.height << " pixels\n";
}

}  // namespace

std::optional<ExitStatus> renderInterlock(const MotionOptions& options, const BoundaryLook& look,
                                          const std::string& size) {
  render::PictureOptions picture = pictureOf(size);
  const auto scene = scene::Scene::load(options.scene);
  const auto found = findInterlock(scene, options);
  if (!found) return std::nullopt;
  const bool isSheet = found->type() == "macro_equilibrium" || found->type() == "macro_motion";
  if (!options.time.empty() && !isSheet) throw InputError("--time", "A limit has no time.");
  warnOfChange(scene, *found);
  picture.caption = scene.normalized()["title"];
  const std::string type = found->type();
  InterlockPlots plots;
  addPlots(scene, *found, plots);
  if (!plots.isEmpty()) {
    drawPlots(plots, picture, options.out);
    return done;
  }
  if (found->isBoundary())
    render::writePng(boundaryImage(*found, look, picture), options.out);
  else if (type == "cell_test")
    render::writePng(limitImage(scene, *found, picture), options.out);
  else if (type == "bending_test")
    render::writePng(patchImage(*scene::readBendingTest(scene, found->folder), picture), options.out);
  else if (type == "gravity_bending")
    render::writePng(patchImage(*scene::readGravityBending(scene, found->folder), picture), options.out);
  else if (isSheet)
    render::writePng(macroImage(scene, *found, options, look, picture), options.out);
  else
    throw InputError(found->folder.string(), "There is no picture of a result of the type " + scene::quote(type) + ".");
  std::cout << options.out << ": " << picture.width << " x " << picture.height << " pixels\n";
  return done;
}

std::optional<ExitStatus> plotInterlock(const PlotOptions& options, const std::string& size) {
  const render::PictureOptions picture = pictureOf(size);
  const auto scene = scene::Scene::load(options.scene);
  InterlockPlots plots;
  for (const std::string& name : options.studies.empty() ? scene::studyNames(scene) : options.studies) {
    const auto found = interlockFolder(options.result, name);
    if (!found && std::filesystem::exists(std::filesystem::path(options.result) / name / "summary.json"))
      return std::nullopt;  // charts of other results
    if (!found) continue;
    const bool none = plots.isEmpty();
    addPlots(scene, *found, plots);
    if (none != plots.isEmpty()) warnOfChange(scene, *found);
  }
  if (plots.isEmpty()) return std::nullopt;
  drawPlots(plots, picture, options.out);
  return done;
}

#endif

}  // namespace pliant::cli
