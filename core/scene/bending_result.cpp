#include "core/scene/bending_result.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene/run_information.hpp"

namespace pliant::scene {

using interlock::BendingKind;
using interlock::BendingLimit;

namespace {

constexpr const char* foldWarning =
    "The patch folds: it stands upright, or elements that are no neighbours hold it, which is no limit of bending.";

Json tripleOf(const Eigen::Vector3d& vector) { return {vector[0], vector[1], vector[2]}; }

/// A curvature where there is a limit, else null.
Json limitOrNull(const BendingLimit& limit, double value) {
  return limit.kind == BendingKind::locked ? Json(value) : Json();
}

Json limitSummary(const BendingLimit& limit) {
  const interlock::CellEquilibrium& rest = limit.equilibrium;
  return {{"outcome", nameOf(limit.kind)},
          {"curvature_limit", limitOrNull(limit, limit.curvature)},
          {"orthogonal_curvature", limitOrNull(limit, limit.orthogonal)},
          {"reached", {{"curvature", limit.curvature}, {"orthogonal_curvature", limit.orthogonal}}},
          {"remote_share", limit.remoteShare},
          {"steepest_slope", limit.steepest},
          {"remaining", rest.remaining},
          {"mean_gap", rest.meanGap},
          {"smallest_gap", rest.smallestGap},
          {"contacts", rest.contacts.size()},
          {"iterations", rest.iterations}};
}

Json bendingUnits() {
  return {{"curvature_limit", "1/m"},
          {"orthogonal_curvature", "1/m"},
          {"reached", "1/m"},
          {"remaining", "curvature that smaller gaps could add, to first order [1/m]"},
          {"remote_share", "of the forces, between elements that are no neighbours at rest"},
          {"steepest_slope", "of the paraboloid below the outermost element"},
          {"mean_gap", "m"},
          {"smallest_gap", "m"},
          {"smallest_radius", "m"},
          {"extent", "m"},
          {"direction", "rad"},
          {"seconds", "s"}};
}

}  // namespace

std::string_view nameOf(BendingKind kind) {
  switch (kind) {
    case BendingKind::locked: return "locked";
    case BendingKind::folded: return "folded";
    case BendingKind::unsettled: break;
  }
  return "unsettled";
}

Eigen::Vector3d curvatureTensor(const Eigen::Vector3d& curvature) {
  return {curvature[0] + curvature[1], curvature[0] - curvature[1], curvature[2]};
}

Eigen::Vector3d BendingBoundaryResult::coordinates(const Eigen::Vector3d& strain) const {
  return curvatureTensor(strain);
}

Json PatchResult::patchSummary() const {
  Json json = materialSummary();
  double extent = 0;
  for (const interlock::InterlockingElement& element : patch->elements)
    extent = std::max(extent, element.position.head<2>().norm());
  json["elements"] = patch->elements.size();
  json["links"] = patch->links.size();
  json["extent"] = extent;
  return json;
}

Json BendingTestResult::summary() const {
  Json json = patchSummary();
  json["direction"] = limit.angle;
  json["lateral"] = provenance.options.value("lateral", "");
  json.update(limitSummary(limit));
  json["curvature_tensor"] = tripleOf(curvatureTensor(limit.equilibrium.state.strain));
  json["units"] = bendingUnits();
  addRunInformation(json, *this);
  return json;
}

std::vector<std::string> BendingTestResult::warnings() const {
  if (limit.kind != BendingKind::folded) return {};
  return {foldWarning};
}

Json CurvatureLimitsResult::summary() const {
  Json json = patchSummary();
  for (const auto& [key, side] :
       {std::pair{"up", &interlock::BendingLimits::up}, {"down", &interlock::BendingLimits::down}}) {
    double low = std::numeric_limits<double>::infinity(), high = -low, lowAcross = low, highAcross = high;
    int locked = 0, folded = 0;
    for (const interlock::BendingLimits& direction : directions) {
      const BendingLimit& limit = direction.*side;
      folded += limit.kind == BendingKind::folded;
      if (limit.kind != BendingKind::locked) continue;
      ++locked;
      low = std::min(low, std::abs(limit.curvature));
      high = std::max(high, std::abs(limit.curvature));
      lowAcross = std::min(lowAcross, limit.orthogonal);
      highAcross = std::max(highAcross, limit.orthogonal);
    }
    Json own = {{"locked", locked}, {"folded", folded}};
    if (locked > 0) {
      own["curvature"] = {{"smallest", low}, {"largest", high}};
      own["orthogonal_curvature"] = {{"smallest", lowAcross}, {"largest", highAcross}};
    }
    json[key] = own;
  }
  json["directions"] = directions.size();
  json["lateral"] = provenance.options.value("lateral", "");
  json["units"] = {{"curvature", "1/m, without its sign"}, {"orthogonal_curvature", "1/m"}, {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

std::vector<std::string> CurvatureLimitsResult::warnings() const {
  int folded = 0;
  for (const interlock::BendingLimits& direction : directions)
    folded += (direction.up.kind == BendingKind::folded) + (direction.down.kind == BendingKind::folded);
  if (folded == 0) return {};
  return {std::to_string(folded) + " of " + std::to_string(2 * directions.size()) + " directions have no limit. " +
          foldWarning};
}

Json BendingSizeResult::summary() const {
  Json json = materialSummary();
  Json rows = Json::array();
  for (const Size& size : sizes) {
    Json row = {{"radius", size.radius}, {"elements", size.elements}};
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = limitSummary(size.limits[i]);
    rows.push_back(row);
  }
  json["sizes"] = rows;
  json["direction"] = provenance.options.value("direction", 0.0);
  json["units"] = bendingUnits();
  addRunInformation(json, *this);
  return json;
}

std::vector<std::string> BendingSizeResult::warnings() const {
  for (const Size& size : sizes)
    for (const BendingLimit& limit : size.limits)
      if (limit.kind == BendingKind::folded) return {std::string("Some patches have no limit. ") + foldWarning};
  return {};
}

Json BendingBoundaryResult::summary() const {
  Json json = patchSummary();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  long iterations = 0;
  double remaining = 0;
  for (std::size_t i = 0; i < boundary.states.size(); ++i) {
    const Eigen::Vector3d tensor = curvatureTensor(boundary.strainAt(static_cast<int>(i)));
    low = low.cwiseMin(tensor);
    high = high.cwiseMax(tensor);
    iterations += boundary.states[i].iterations;
    remaining = std::max(remaining, boundary.states[i].remaining);
  }
  json["states"] = boundary.states.size();
  json["triangles"] = boundary.mesh.triangles.size();
  json["closed"] = boundary.isClosed();
  json["middle"] = tripleOf(boundary.middle);
  json["mean_distance"] = boundary.meanDistance();
  json["volume"] = boundary.volume();
  json["curvature_tensor"] = {{"smallest", tripleOf(low)}, {"largest", tripleOf(high)}};
  json["largest_gap_over_radius"] = boundary.largestGap() / patch->smallestRadius();
  json["largest_remaining"] = remaining;
  json["estimated_error"] = {{"largest", boundary.largestError}, {"mean", boundary.meanError}};
  json["raised_by_neighbours"] = boundary.count(&interlock::BoundaryState::raised);
  json["not_star_shaped"] = boundary.count(&interlock::BoundaryState::seesBeyond);
  json["star_shape_tested"] = provenance.options.value("test_star_shape", true);
  json["iterations"] = iterations;
  json["recalled"] = recalled;
  json["units"] = {{"middle", "mean, deviator, twist of the curvature [1/m]"},
                   {"mean_distance", "1/m"},
                   {"curvature_tensor", "k_xx, k_yy, k_xy [1/m]"},
                   {"largest_remaining", "1/m"},
                   {"estimated_error", "of the surface between the rays, over the mean distance"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

std::vector<std::string> BendingBoundaryResult::warnings() const {
  std::vector<std::string> sentences;
  const auto folded = std::count_if(boundary.states.begin(), boundary.states.end(),
                                    [](const auto& state) { return state.kind == interlock::RestKind::unlimited; });
  if (folded > 0)
    sentences.push_back("The set is not bounded in " + std::to_string(folded) + " of " +
                        std::to_string(boundary.states.size()) + " directions. " + foldWarning);
  if (const int count = boundary.count(&interlock::BoundaryState::seesBeyond); count > 0)
    sentences.push_back("The set is not star-shaped in " + std::to_string(count) +
                        " directions: this surface bounds the part that can be reached straight from its middle.");
  sentences.emplace_back("Limits of bending hold for this patch: those of double curvature fall as it grows.");
  return sentences;
}

Json GravityBendingResult::summary() const {
  Json json = patchSummary();
  const Eigen::Vector2d along(std::cos(direction), std::sin(direction));
  double farthest = -std::numeric_limits<double>::infinity(), drop = 0, reach = 0, most = 0;
  for (std::size_t i = 0; i < patch->elements.size(); ++i) {
    const Eigen::Vector3d before = patch->elements[i].position;
    const Eigen::Vector3d now = rest.state.positions.col(static_cast<Eigen::Index>(i));
    most = std::max(most, (now - before).norm());
    if (before.head<2>().dot(along) <= farthest) continue;
    farthest = before.head<2>().dot(along);
    drop = (now - before).z();
    reach = (now - before).head<2>().dot(along);
  }
  json["direction"] = direction;
  json["clamped"] = clamped.size();
  json["weight"] = weight;
  json["reaction"] = tripleOf(reaction);
  json["tip_displacement"] = {{"along", reach}, {"z", drop}};
  json["largest_displacement"] = most;
  json["rest"] = nameOf(rest.kind);
  json["remaining"] = rest.remaining;
  json["mean_gap"] = rest.meanGap;
  json["smallest_gap"] = rest.smallestGap;
  json["contacts"] = rest.contacts.size();
  json["iterations"] = rest.iterations;
  json["units"] = {{"direction", "rad"},
                   {"weight", "N"},
                   {"reaction", "force of the free elements on the clamped ones [N]"},
                   {"tip_displacement", "of the element that is farthest in the direction at rest [m]"},
                   {"largest_displacement", "m"},
                   {"remaining", "energy that smaller gaps could save, to first order [J]"},
                   {"mean_gap", "m"},
                   {"smallest_gap", "m"},
                   {"extent", "m"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

}  // namespace pliant::scene
