#include "core/scene/interlock_result.hpp"

#include <algorithm>
#include <cmath>

#include "core/scene/run_information.hpp"

namespace pliant::scene {

using Eigen::Vector3d;

namespace {

Json listOf(const Vector3d& vector) { return {vector[0], vector[1], vector[2]}; }

const char* compressionWarning() {
  return "A compression limit holds for this supercell alone: cells that may fold differently from their neighbours "
         "can usually be compressed further.";
}

}  // namespace

std::string_view nameOf(interlock::RestKind kind) {
  switch (kind) {
    case interlock::RestKind::locked: return "locked";
    case interlock::RestKind::reached: return "reached";
    case interlock::RestKind::unlimited: break;
  }
  return "unlimited";
}

Json InterlockResult::materialSummary() const {
  Json json = summaryHead(*this);
  json["cell"] = cell->name;
  json["elements_in_cell"] = cell->elements.size();
  json["perturbation"] = provenance.options.value("perturbation", 0.0);
  if (const double friction = provenance.options.value("friction", 0.0); friction > 0) json["friction"] = friction;
  json["smallest_radius"] = cell->smallestRadius();
  return json;
}

Json CellTestResult::summary() const {
  Json json = materialSummary();
  const interlock::CellEquilibrium& rest = limit.equilibrium;
  const Eigen::Matrix2d stretch = interlock::stretchOf(rest.state.strain);
  json["direction"] = limit.angle;
  json["strain"] = limit.strain;
  json["remaining"] = rest.remaining;
  json["rest"] = nameOf(rest.kind);
  json["stretch"] = {{"x", stretch(0, 0)}, {"y", stretch(1, 1)}, {"xy", stretch(0, 1)}};
  json["green_strain"] = listOf(interlock::greenStrain(rest.state.strain));
  json["mean_gap"] = rest.meanGap;
  json["smallest_gap"] = rest.smallestGap;
  json["contacts"] = rest.contacts.size();
  json["iterations"] = rest.iterations;
  json["units"] = {{"direction", "rad"},
                   {"strain", "length over length at rest - 1"},
                   {"remaining", "strain that smaller gaps could add, to first order"},
                   {"mean_gap", "m"},
                   {"smallest_gap", "m"},
                   {"smallest_radius", "m"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

std::vector<std::string> CellTestResult::warnings() const {
  if (provenance.options.value("load", "") != "compress") return {};
  return {compressionWarning()};
}

Json FreeTravelResult::summary() const {
  Json json = materialSummary();
  const auto range = [&](const char* key, auto&& value) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const interlock::FreeTravel& direction : directions) {
      low = std::min(low, value(direction));
      high = std::max(high, value(direction));
    }
    json[key] = {{"smallest", low}, {"largest", high}};
  };
  range("free_travel", [](const interlock::FreeTravel& direction) { return direction.travel(); });
  range("stretch", [](const interlock::FreeTravel& direction) { return direction.stretch.strain; });
  range("compression", [](const interlock::FreeTravel& direction) { return direction.compression.strain; });
  json["directions"] = directions.size();
  json["units"] = {{"free_travel", "(stretch - compression) / (1 + compression)"}, {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

std::vector<std::string> FreeTravelResult::warnings() const { return {compressionWarning()}; }

Json StretchGridResult::summary() const {
  Json json = materialSummary();
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double remaining = 0;
  for (const interlock::GridSlice& slice : grid.slices)
    for (const auto* limit : {&slice.stretched, &slice.compressed}) {
      const Vector3d green = interlock::greenStrain(limit->equilibrium.state.strain);
      low = low.cwiseMin(green);
      high = high.cwiseMax(green);
      remaining = std::max(remaining, limit->equilibrium.remaining);
    }
  json["limits"] = 2 * grid.slices.size();
  json["missed_slices"] = grid.missedCount();
  json["green_strain"] = {{"smallest", listOf(low)}, {"largest", listOf(high)}};
  json["largest_gap_over_radius"] = grid.largestGap() / cell->smallestRadius();
  json["largest_remaining"] = remaining;
  json["iterations"] = grid.iterations();
  json["units"] = {{"missed_slices", "that locked before the principal strain that was asked for"},
                   {"largest_remaining", "strain that smaller gaps could add, to first order"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

std::vector<std::string> StretchGridResult::warnings() const { return {compressionWarning()}; }

Json StretchBoundaryResult::summary() const {
  Json json = materialSummary();
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  long iterations = 0;
  double remaining = 0;
  for (std::size_t i = 0; i < boundary.states.size(); ++i) {
    const Vector3d green = interlock::greenStrain(boundary.strainAt(static_cast<int>(i)));
    low = low.cwiseMin(green);
    high = high.cwiseMax(green);
    iterations += boundary.states[i].iterations;
    remaining = std::max(remaining, boundary.states[i].remaining);
  }
  json["states"] = boundary.states.size();
  json["triangles"] = boundary.mesh.triangles.size();
  json["closed"] = boundary.isClosed();
  json["middle"] = listOf(boundary.middle);
  json["mean_distance"] = boundary.meanDistance();
  json["volume"] = boundary.volume();
  json["green_strain"] = {{"smallest", listOf(low)}, {"largest", listOf(high)}};
  json["largest_gap_over_radius"] = boundary.largestGap() / cell->smallestRadius();
  json["largest_remaining"] = remaining;
  json["estimated_error"] = {{"largest", boundary.largestError}, {"mean", boundary.meanError}};
  json["raised_by_neighbours"] = boundary.count(&interlock::BoundaryState::raised);
  json["not_star_shaped"] = boundary.count(&interlock::BoundaryState::seesBeyond);
  json["star_shape_tested"] = provenance.options.value("test_star_shape", true);
  json["symmetries"] = boundary.symmetries;
  json["computed_limits"] = boundary.computedRays;
  json["symmetry_check"] = {{"limits", boundary.checkedRays}, {"largest_difference", boundary.symmetryDifference}};
  json["iterations"] = iterations;
  json["recalled"] = recalled;
  json["units"] = {{"middle", "strain coordinates: mean, deviator, shear of the stretch"},
                   {"mean_distance", "strain"},
                   {"estimated_error", "of the surface between the rays, over the mean distance"},
                   {"largest_remaining", "strain that smaller gaps could add, to first order"},
                   {"largest_difference", "of limits that symmetries make the same, over their distance"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

std::vector<std::string> StretchBoundaryResult::warnings() const {
  std::vector<std::string> sentences;
  if (const int count = boundary.count(&interlock::BoundaryState::seesBeyond); count > 0)
    sentences.push_back("The set is not star-shaped in " + std::to_string(count) +
                        " directions: this surface bounds the part that can be reached straight from its middle.");
  if (boundary.symmetryDifference > 1e-3)
    sentences.push_back("Symmetric directions fold in different ways, and then lock up to " +
                        std::to_string(std::lround(100 * boundary.symmetryDifference)) +
                        " per cent apart; each has the farthest that was found.");
  sentences.emplace_back(
      "Limits under compression hold for this supercell alone: cells that may fold differently from their neighbours "
      "can usually be compressed further.");
  return sentences;
}

}  // namespace pliant::scene
