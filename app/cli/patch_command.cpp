#include <cstdio>
#include <iostream>

#include "app/cli/commands.hpp"
#include "app/cli/interlock_pictures.hpp"
#include "core/base/error.hpp"
#include "core/base/units.hpp"
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

ExitStatus exportPatch(const MotionOptions& options, const PatchSettings& settings) {
  if (!options.result.empty()) {
    if (const auto status = exportBoundary(options)) return *status;
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
  std::cout << options.out << ": " << report.elements << " elements, " << report.triangles << " triangles, "
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
  return done;
}

}  // namespace pliant::cli
