#include <cstdio>
#include <iostream>

#include "app/cli/commands.hpp"
#include "app/cli/interlock_pictures.hpp"
#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/scene/detail_export.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/macro_reading.hpp"
#include "core/scene/patch_export.hpp"

namespace pliant::cli {

namespace dimensions = base::dimensions;

namespace {

double lengthOption(const std::string& option, const std::string& text, double otherwise) {
  if (text.empty()) return otherwise;
  try {
    const double length = base::parseQuantity(text, dimensions::length);
    if (!(length > 0)) throw base::InputError("", "Expected a length above 0.");
    return length;
  } catch (const base::InputError& error) {
    throw base::InputError(option, error.problem());
  }
}

std::string length(double value) { return base::formatQuantity(value, dimensions::length); }

}  // namespace

bool isPatch(const MotionOptions& options) { return scene::isFabric(scene::Scene::load(options.scene)); }

namespace {

/// The placed elements of the sheet that the options name; nothing if they name something else.
std::optional<scene::PatchReport> exportSheet(const MotionOptions& options, const PatchSettings& settings) {
  const auto scene = scene::Scene::load(options.scene);
  const std::vector<std::string> names = scene::studyNames(scene);
  const std::string study = options.study.empty() && names.size() == 1 ? names.front() : options.study;
  const auto folder = std::filesystem::path(options.result) / study;
  if (study.empty() || !std::filesystem::exists(folder / "summary.json")) return std::nullopt;
  const scene::Json summary = scene::parseJson(scene::readTextFile(folder / "summary.json"));
  if (!summary.value("type", "").starts_with("macro_")) return std::nullopt;
  const scene::PatchRequest defaults;
  base::ExecutionContext context;
  return scene::exportPlaced(
      *scene::readMacro(scene, folder), lengthOption("--tolerance", settings.tolerance, defaults.tolerance),
      lengthOption("--clearance", settings.clearance, defaults.minimumClearance), options.out, context);
}

void print(const std::string& file, const scene::PatchReport& report) {
  std::cout << file << ": " << report.elements << " elements, " << report.triangles << " triangles, "
            << length(report.size[0]) << " x " << length(report.size[1]) << " x " << length(report.size[2]) << ", ";
  char volume[32];
  std::snprintf(volume, sizeof volume, "%.4g", report.volume * 1e6);
  std::cout << volume << " cm^3\nClearance between elements " << length(report.clearance) << "; meshes are within "
            << length(report.deviation) << " of the exact surfaces\n";
  if (report.filled > 0)
    std::cout << "Narrow openings within elements are filled, up to " << length(report.filled) << " from their walls\n";
  if (report.leftOut > 0)
    std::cout << report.leftOut << " elements at the outline are left out, since they are not linked to the rest\n";
  if (report.clearance <= 2 * report.deviation)
    std::cout << "Meshes may touch, since elements are nearer to each other than twice that\n";
}

}  // namespace

ExitStatus exportPatch(const MotionOptions& options, const PatchSettings& settings) {
  if (!options.result.empty()) {
    if (const auto status = exportBoundary(options)) return *status;
    if (const auto report = exportSheet(options, settings)) {
      print(options.out, *report);
      return done;
    }
    throw base::InputError(
        "--result", "Limit states of interlocking materials are computed anew; name the study only.");
  }
  const auto scene = scene::Scene::load(options.scene);
  scene::PatchRequest request;
  request.cell = settings.cell;
  request.study = options.study;
  if (!settings.outline.empty()) request.outline = settings.outline;
  request.tolerance = lengthOption("--tolerance", settings.tolerance, request.tolerance);
  request.minimumClearance = lengthOption("--clearance", settings.clearance, request.minimumClearance);
  base::ExecutionContext context;
  const scene::PatchReport report = scene::exportPatch(scene, request, options.out, context);
  print(options.out, report);
  return done;
}

}  // namespace pliant::cli
