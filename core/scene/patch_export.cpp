#include "core/scene/patch_export.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "core/interlock/element_body.hpp"
#include "core/interlock/fabric_patch.hpp"
#include "core/math/parallel.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/interlock_builder.hpp"
#include "core/scene/interlock_result.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/outline_file.hpp"
#include "core/scene/print_bodies.hpp"

namespace pliant::scene {

using base::InputError;
namespace dimensions = base::dimensions;

namespace {

/// A material in the state that is wanted.
struct Fabric {
  interlock::UnitCell cell;
  interlock::CellState state;
};

const Json& studyNamed(const Scene& scene, const std::string& name) {
  for (const Json& study : scene.normalized()["studies"])
    if (study["name"] == name) return study;
  throw InputError(scene.name() + ": /studies", "There is no study named " + quote(name) + ".");
}

Fabric fabricAtLimit(const Scene& scene, const PatchRequest& request, base::ExecutionContext& context) {
  const Json& study = studyNamed(scene, request.study);
  if (study["type"] != "cell_test")
    throw InputError(scene.name() + ": /studies", "The study " + quote(request.study) + " is of type " +
                                                      quote(study["type"].get<std::string>()) +
                                                      ", but only a \"cell_test\" has one limit state.");
  if (!request.cell.empty() && study["cell"] != request.cell)
    throw InputError(scene.name() + ": /studies", "The study " + quote(request.study) + " is one of the cell " +
                                                      quote(study["cell"].get<std::string>()) + ", not " +
                                                      quote(request.cell) + ".");
  const auto result = StudyRegistry::instance().make(scene, buildModel(scene), request.study)->run(context);
  const auto& test = dynamic_cast<const CellTestResult&>(*result);
  if (test.termination != base::TerminationType::converged)
    throw InputError(
        scene.name(), asSentence("The study " + quote(request.study) + " has no limit state: " + test.message));
  return {*test.cell, test.limit.equilibrium.state};
}

Fabric fabricAtRest(const Scene& scene, const PatchRequest& request) {
  const Json& cells = scene.normalized()["interlocking_cells"];
  std::string name = request.cell;
  if (name.empty() && cells.size() == 1) name = cells[0]["name"];
  if (std::none_of(cells.begin(), cells.end(), [&](const Json& cell) { return cell["name"] == name; }))
    throw InputError(
        scene.name() + ": /interlocking_cells",
        name.empty() ? "There are " + std::to_string(cells.size()) + " materials; --cell must say which one is wanted."
                     : "There is no material named " + quote(name) + ".");
  const interlock::UnitCell cell = buildCell(scene, name);
  return {cell, restState(cell)};
}

double lengthFrom(const std::string& text) {
  const double length = base::parseQuantity(text, dimensions::length);
  if (!(length > 0)) throw InputError("", "the lengths of an outline must be above 0");
  return length;
}

bool isWholeNumber(const std::string& text) {
  return !text.empty() && text.size() <= 6 && text.find_first_not_of("0123456789") == std::string::npos;
}

interlock::FabricPatch patchFrom(const Fabric& fabric, const std::string& outline) {
  if (outline.ends_with(".csv")) {
    const Eigen::Matrix2Xd polygon = readOutline(outline).front();
    return locate(outline, [&] { return patchInside(fabric.cell, fabric.state, polygon); });
  }
  return locate("--patch " + quote(outline), [&] {
    const std::size_t cross = outline.find('x');
    if (cross == std::string::npos)
      return patchInside(fabric.cell, fabric.state, interlock::circleOutline(lengthFrom(outline)));
    const std::string first = outline.substr(0, cross), second = outline.substr(cross + 1);
    if (isWholeNumber(first) && isWholeNumber(second))
      return patchOfCells(fabric.cell, std::stoi(first), std::stoi(second));
    return patchInside(fabric.cell, fabric.state, interlock::rectangleOutline(lengthFrom(first), lengthFrom(second)));
  });
}

/// One mesh for each shape that the patch has elements of; others are empty.
std::vector<geometry::BodyMesh> bodiesOf(const Fabric& fabric, const interlock::FabricPatch& patch, double tolerance) {
  std::vector<geometry::BodyMesh> bodies(fabric.cell.shapes.size());
  std::vector<bool> used(bodies.size(), false);
  for (const interlock::PatchElement& element : patch.elements)
    used[static_cast<std::size_t>(fabric.cell.elements[element.element].shape)] = true;
  math::parallelFor(static_cast<int>(bodies.size()), [&](int i) {
    if (used[i]) bodies[i] = interlock::ElementBody(fabric.cell.shapes[i]).mesh(tolerance);
  });
  return bodies;
}

Fabric fabricOf(const Scene& scene, const PatchRequest& request, base::ExecutionContext& context) {
  return request.study.empty() ? fabricAtRest(scene, request) : fabricAtLimit(scene, request, context);
}

PatchReport reportOf(const Fabric& fabric, const interlock::FabricPatch& patch) {
  PatchReport report;
  report.elements = static_cast<int>(patch.elements.size());
  report.leftOut = patch.leftOut;
  report.clearance = clearance(fabric.cell, fabric.state);
  return report;
}

}  // namespace

bool isFabric(const Scene& scene) {
  return scene.normalized()["geometry"].empty() && !scene.normalized()["interlocking_cells"].empty();
}

PatchReport inspectPatch(const Scene& scene, const PatchRequest& request, base::ExecutionContext& context) {
  const Fabric fabric = fabricOf(scene, request, context);
  return reportOf(fabric, patchFrom(fabric, request.outline));
}

PatchReport exportPatch(const Scene& scene, const PatchRequest& request, const std::filesystem::path& file,
                        base::ExecutionContext& context) {
  const Fabric fabric = fabricOf(scene, request, context);
  const interlock::FabricPatch patch = patchFrom(fabric, request.outline);
  PatchReport report = reportOf(fabric, patch);
  const auto show = [](double length) { return base::formatQuantity(length, dimensions::length); };
  if (report.clearance < request.minimumClearance)
    throw InputError(scene.name(), "Elements are " + show(report.clearance) + " apart, but at least " +
                                       show(request.minimumClearance) + " are asked for.");

  context.reportProgress(0.05);
  const std::vector<geometry::BodyMesh> bodies =
      locate(scene.name(), [&] { return bodiesOf(fabric, patch, request.tolerance); });
  context.reportProgress(0.5);
  report.cancelled = context.cancelRequested();
  if (report.cancelled) return report;
  std::vector<geometry::BodyCopy> copies;
  for (const interlock::PatchElement& element : patch.elements)
    copies.push_back({fabric.cell.elements[element.element].shape, fabric.state.rotations[element.element],
                      placeOf(fabric.cell, fabric.state, element)});
  writeBodies(bodies, std::move(copies), file, report, context);
  return report;
}

}  // namespace pliant::scene
