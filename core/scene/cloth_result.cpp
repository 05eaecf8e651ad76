#include "core/scene/cloth_result.hpp"

#include <algorithm>
#include <cmath>

#include "core/scene/run_information.hpp"

namespace pliant::scene {

namespace {

/// JSON knows no infinity: null says that nothing is near, or that nothing is proved.
Json finiteOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json energiesJson(const cloth::Energies& energies) {
  return {{"kinetic", energies.kinetic}, {"membrane", energies.membrane}, {"bending", energies.bending},
          {"gravity", energies.gravity}, {"other", energies.other},       {"contact", energies.contact},
          {"total", energies.total()}};
}

Json projectionJson(const solvers::ConeSolution& solution) {
  return {{"objective", solution.objective},
          {"bound", finiteOrNull(solution.bound)},
          {"gap", finiteOrNull(solution.gap())},
          {"relative_gap", finiteOrNull(solution.relativeGap())},
          {"violation", solution.violation},
          {"dual_residual", finiteOrNull(solution.dualResidual)},
          {"complementarity", finiteOrNull(solution.complementarity)},
          {"iterations", solution.report.iterations.size()},
          {"seconds", solution.report.seconds},
          {"conflicting_triangles", solution.conflictingElements},
          {"conflicting_pins", solution.conflictingNodes}};
}

void addSteps(Json& json, const std::vector<ClothStepRecord>& steps) {
  ClothStepRecord sum;
  double gap = std::numeric_limits<double>::infinity();
  int unconverged = 0;
  for (const ClothStepRecord& step : steps) {
    sum.violation = std::max(sum.violation, step.violation);
    sum.relativeGap = std::max(sum.relativeGap, step.relativeGap);
    sum.newtonIterations += step.newtonIterations;
    sum.projectionIterations += step.projectionIterations;
    sum.newtonSeconds += step.newtonSeconds;
    sum.projectionSeconds += step.projectionSeconds;
    gap = std::min(gap, step.smallestGap);
    unconverged += !step.converged;
  }
  const double count = std::max<double>(1, static_cast<double>(steps.size()));
  json["steps"] = steps.size();
  json["steps_not_converged"] = unconverged;
  json["violation"] = sum.violation;
  json["relative_gap"] = finiteOrNull(sum.relativeGap);
  json["smallest_gap"] = finiteOrNull(gap);
  json["newton_iterations"] = sum.newtonIterations;
  json["projection_iterations"] = sum.projectionIterations;
  json["newton_seconds"] = sum.newtonSeconds;
  json["projection_seconds"] = sum.projectionSeconds;
  json["newton_seconds_per_step"] = sum.newtonSeconds / count;
  json["projection_seconds_per_step"] = sum.projectionSeconds / count;
}

Json probePlaces(const mechanics::Model& model, const ClothFrame& frame) {
  Json probes = Json::array();
  for (const mechanics::Probe& probe : model.probes) {
    const auto place = frame.positions.col(probe.node);
    probes.push_back({{"name", probe.name}, {"position", {place.x(), place.y(), place.z()}}});
  }
  return probes;
}

}  // namespace

std::string ClothResult::studyType() const { return provenance.options.value("type", ""); }

std::shared_ptr<const ClothFrame> ClothResult::frameAt(double time) const {
  const double within = std::clamp(time, frames.front()->time, frames.back()->time);
  return *std::min_element(frames.begin(), frames.end(), [&](const auto& a, const auto& b) {
    return std::abs(a->time - within) < std::abs(b->time - within);
  });
}

std::vector<std::string> ClothResult::warnings() const {
  std::vector<std::string> sentences;
  const auto unconverged =
      std::count_if(steps.begin(), steps.end(), [](const ClothStepRecord& step) { return !step.converged; });
  if (unconverged > 0)
    sentences.push_back(std::to_string(unconverged) + " of " + std::to_string(steps.size()) +
                        " steps were not solved as exactly as asked.");
  if (problem && studyType() == "projection" && (problem->selfContact || !problem->bodies.empty()))
    sentences.emplace_back("A projection looks at limits alone: here bodies and self-contact are left out.");
  double overshoot = 0;
  if (problem)
    for (const cloth::LimitConstraints& constraints : problem->sheet.constraints)
      overshoot = std::max(overshoot, constraints.overshoot);
  if (overshoot > 1e-3)
    sentences.push_back("Between the directions that a limit samples, the stretch may exceed it by up to " +
                        base::formatQuantity(100 * overshoot, {}) + " %.");
  return sentences;
}

Json ClothResult::summary() const {
  Json json = summaryHead(*this);
  const bool drape = studyType() == "cloth_drape";
  if (!steps.empty()) {
    if (drape)
      json["residual"] = finiteOrNull(steps.back().residual);
    else
      json["time"] = steps.back().time;
    addSteps(json, steps);
    json["energy_start"] = energiesJson(steps.front().energies);
    json["energy_end"] = energiesJson(steps.back().energies);
  }
  if (studyType() == "projection" && projection) json["projection"] = projectionJson(*projection);
  json["frames"] = frames.size();
  if (!frames.empty()) {
    const ClothFrame& last = *frames.back();
    json["largest_stretch_ratio"] = last.stretchRatios.size() > 0 ? last.stretchRatios.maxCoeff() : 0.0;
    json["limited_triangles"] = (last.stretchRatios.array() > 0).count();
    json["probes"] = probePlaces(*problem->model, last);
  }
  json["nodes"] = problem->model->nodeCount();
  json["triangles"] = problem->sheet.triangles.size();
  json["units"] = {{"energy", "J, those of the first and the last step"},
                   {"violation", "largest stretch over limit - 1"},
                   {"relative_gap", "duality gap of a projection over its objective"},
                   {"objective", "kg m^2, or m^2 with the norm \"identity\""},
                   {"residual", "force that neither elasticity nor limits balance, over the external force"},
                   {"smallest_gap", "m"},
                   {"position", "m"},
                   {"time", "s"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

}  // namespace pliant::scene
