#include "ui/render/patch_configuration.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/base/units.hpp"
#include "core/interlock/holding_contacts.hpp"

namespace pliant::render {
namespace {

namespace dimensions = base::dimensions;

constexpr double apart = 0.5;      ///< contacts of two elements nearer than this are one [smallest radii]
constexpr double flattest = 1e-9;  ///< a curvature below this has no radius worth telling [1/m]

/// With a sign that is as wide as a plus.
std::string signedText(const std::string& number) { return number.starts_with('-') ? "−" + number.substr(1) : number; }

std::string number(double value, int digits = 4) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return signedText(text);
}

std::string perMetre(double value, int digits = 4) { return number(value, digits) + " 1/m"; }
std::string length(double value) { return signedText(base::formatQuantity(value, dimensions::length)); }
std::string degrees(double angle) { return number(angle * 180 / std::numbers::pi) + "°"; }

std::string radiusText(double curvature) {
  return std::abs(curvature) < flattest ? "flat" : "radius " + length(1 / std::abs(curvature));
}

std::vector<interlock::CellContactForce> distinct(const interlock::UnitCell& patch,
                                                  std::vector<interlock::CellContactForce> contacts) {
  return interlock::distinctContacts(std::move(contacts), apart * patch.smallestRadius());
}

std::shared_ptr<PatchConfiguration> configurationOf(const scene::PatchResult& result,
                                                    const interlock::CellEquilibrium& rest) {
  if (!result.patch || rest.state.rotations.empty()) return nullptr;
  auto configuration = std::make_shared<PatchConfiguration>();
  configuration->patch = result.patch;
  configuration->state = rest.state;
  configuration->contacts = distinct(*result.patch, rest.contacts);
  return configuration;
}

double extentOf(const interlock::UnitCell& patch) {
  double extent = 0;
  for (const auto& element : patch.elements) extent = std::max(extent, element.position.head<2>().norm());
  return extent;
}

std::string sizeText(const interlock::UnitCell& patch) {
  return std::to_string(patch.elements.size()) + " elements,  farthest " + length(extentOf(patch)) + " from the middle";
}

std::string heldText(const scene::PatchResult& result, const interlock::CellEquilibrium& rest) {
  const double radius = result.patch->smallestRadius();
  return "held at " + std::to_string(distinct(*result.patch, rest.contacts).size()) + " places,  mean gap " +
         length(rest.meanGap) + " (" + number(rest.meanGap / radius, 2) + " wire radii)";
}

}  // namespace

std::shared_ptr<const PatchConfiguration> patchConfiguration(const scene::BendingTestResult& result) {
  auto configuration = configurationOf(result, result.limit.equilibrium);
  if (configuration) configuration->curvature = result.limit.equilibrium.state.strain;
  return configuration;
}

std::shared_ptr<const PatchConfiguration> patchConfiguration(const scene::GravityBendingResult& result) {
  auto configuration = configurationOf(result, result.rest);
  if (!configuration) return nullptr;
  configuration->clamped = result.clamped;
  configuration->gravity = result.gravity;
  return configuration;
}

std::shared_ptr<const PatchConfiguration> patchConfiguration(const scene::BendingBoundaryResult& result, int state) {
  const interlock::BoundaryState& limit = result.boundary.states.at(static_cast<std::size_t>(state));
  if (limit.cell.rotations.empty()) return nullptr;
  const interlock::EquilibriumOptions defaults;
  const double range = defaults.rangeRatio * result.provenance.options.value("final_gap", defaults.finalGap) *
                       result.patch->smallestRadius();
  auto configuration = std::make_shared<PatchConfiguration>();
  configuration->patch = result.patch;
  configuration->state = limit.cell;
  configuration->curvature = limit.cell.strain;
  configuration->contacts =
      distinct(*result.patch, interlock::holdingContacts(interlock::CellContact(*result.patch), limit.cell, range));
  return configuration;
}

std::string patchCaption(const scene::BendingTestResult& result) {
  const interlock::BendingLimit& limit = result.limit;
  const interlock::CellEquilibrium& rest = limit.equilibrium;
  const std::string name = result.provenance.study;
  if (!rest.converged()) return name + ":  " + result.message;
  const std::string lateral = result.provenance.options.value("lateral", "principal");
  const std::string across = lateral == "held" ? "held flat across" : "across " + perMetre(limit.orthogonal);
  if (limit.kind == interlock::BendingKind::folded)
    return name + ":  no limit, the patch folds\nreached " + perMetre(limit.curvature) + " at " + degrees(limit.angle) +
           ",  " + across + ",  slope " + number(limit.steepest, 3) + " at the rim\n" +
           number(100 * limit.remoteShare, 3) + " % of the forces are between elements that are no neighbours\n" +
           sizeText(*result.patch);
  return name + ":  " + perMetre(limit.curvature) + " at " + degrees(limit.angle) + ",  " +
         radiusText(limit.curvature) + ",  " + across + "\n" + heldText(result, rest) + ";  smaller gaps could add " +
         perMetre(rest.remaining, 2) + "\nholds for this patch:  " + sizeText(*result.patch);
}

std::string patchCaption(const scene::GravityBendingResult& result) {
  const std::string name = result.provenance.study;
  if (result.termination != base::TerminationType::converged) return name + ":  " + result.message;
  const scene::Json summary = result.summary();
  const scene::Json& tip = summary["tip_displacement"];
  return name + ":  the farthest element is moved " + length(tip["z"]) + " in z,  " + length(tip["along"]) + " along " +
         degrees(result.direction) + "\nweight " + base::formatQuantity(result.weight, dimensions::force) + ",  " +
         std::to_string(result.clamped.size()) + " elements clamped\n" + heldText(result, result.rest) + "\n" +
         sizeText(*result.patch);
}

std::string patchCaption(const scene::BendingBoundaryResult& result, int state) {
  const interlock::BoundaryState& limit = result.boundary.states.at(static_cast<std::size_t>(state));
  const double radius = result.patch->smallestRadius();
  return result.provenance.study + ",  limit " + std::to_string(state) + "\n" +
         curvatureText(scene::curvatureTensor(result.boundary.strainAt(state))) + "\nmean gap " +
         length(limit.meanGap) + " (" + number(limit.meanGap / radius, 2) + " wire radii);  smaller gaps could add " +
         perMetre(limit.remaining, 2) + "\nholds for this patch:  " + sizeText(*result.patch);
}

std::string curvatureText(const Eigen::Vector3d& tensor) {
  const double mean = 0.5 * (tensor[0] + tensor[1]), half = 0.5 * (tensor[0] - tensor[1]);
  const double spread = std::hypot(half, tensor[2]);
  const double angle = spread > 0 ? 0.5 * std::atan2(tensor[2], half) : 0;
  return "k_xx " + perMetre(tensor[0]) + ",  k_yy " + perMetre(tensor[1]) + ",  k_xy " + perMetre(tensor[2]) +
         ";  k₁ " + perMetre(mean + spread) + " at " + number(std::round(angle * 180 / std::numbers::pi)) + "°,  k₂ " +
         perMetre(mean - spread);
}

}  // namespace pliant::render
