#include "core/interlock/macro_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/mechanics/shell.hpp"

namespace pliant::interlock {

namespace {

using base::TerminationType;
using Eigen::Index;
using mechanics::AdmissibleStrainSet;
using mechanics::StrainLimitFunction;

/// The first barrier: as an energy, this much of the work that the loads could do over the size of the sheet.
constexpr double firstBarrier = 0.1;
constexpr double barrierDecay = 0.1;
/// Of which there are at most so many, where loads do next to no work.
constexpr int mostBarriers = 20;
/// Until the last barrier equilibria are only followed.
constexpr double looseTolerance = 1e-3;
/// Of an increment with friction, over the size of the sheet: how far contacts creep, and how long it is.
constexpr double creepOfRest = 1e-4;
constexpr double longestIncrement = 0.02;

std::shared_ptr<const mechanics::ElasticAssembler> assemblerOf(
    const Vector& rest, const std::vector<std::shared_ptr<const mechanics::Energy>>& energies) {
  auto model = std::make_shared<mechanics::Model>();
  model->dimension = 3;
  model->restPositions = rest;
  model->energies = energies;
  model->finish();
  return std::make_shared<const mechanics::ElasticAssembler>(std::move(model));
}

void checkMaterial(const MacroMaterial& material, double margin) {
  const auto mustBeAbove = [](double value, const char* what) {
    if (!(value > 0) || !std::isfinite(value))
      throw base::InputError("", std::string(what) + " must be above 0, but is " + std::to_string(value) + ".");
  };
  mustBeAbove(material.youngModulus, "Young's modulus");
  mustBeAbove(material.density, "The density");
  mustBeAbove(material.thickness, "The thickness");
  for (const auto& set : {material.stretch, material.bending}) {
    const double rest = set ? set->gauge(Eigen::Vector3d::Zero()).value : 0;
    if (!(rest < 1)) throw base::InputError("", "A material's limits do not allow for its shape at rest.");
    if (!(rest < 1 - margin))
      throw base::InputError("", "A margin of " + std::to_string(margin) +
                                     " does not allow for a material's shape at rest; that needs less than " +
                                     std::to_string(1 - rest) + ".");
  }
}

}  // namespace

MacroSimulation::MacroSimulation(MacroSheet sheet, const MacroOptions& options, MacroContact contact)
    : sheet_(std::move(sheet)), options_(options), contact_(std::move(contact)) {
  geometry::checkMesh(sheet_.mesh);
  const Eigen::Matrix3Xd& points = sheet_.mesh.points;
  if (points.row(2).cwiseAbs().maxCoeff() > 1e-9 * size())
    throw base::InputError("", "A sheet of interlocking material must lie in the plane z = 0 at rest.");
  if (!(options_.margin >= 0 && options_.margin < 1))
    throw base::InputError("", "The margin must be at least 0 and below 1.");
  if (options_.margin > 0 && options_.limits != StrainLimitFunction::Kind::barrier)
    throw base::InputError("", "A penalty keeps no margin.");
  if (sheet_.materials.empty()) throw base::InputError("", "A sheet of interlocking material needs a material.");
  for (const MacroMaterial& material : sheet_.materials) checkMaterial(material, options_.margin);
  if (!(contact_.friction >= 0) || !std::isfinite(contact_.friction))
    throw base::InputError("", "The coefficient of friction must not be negative.");
  masses_.setZero(points.cols());
  std::vector<std::shared_ptr<const mechanics::Energy>> elastic, limits;
  const auto count = static_cast<Index>(sheet_.mesh.triangles.size());
  areas_.resize(count);
  std::vector<mechanics::Triangles> parts(sheet_.materials.size());
  for (Index t = 0; t < count; ++t) {
    const auto index = static_cast<std::size_t>(t);
    const int own = sheet_.materialOf.empty() ? 0 : sheet_.materialOf.at(index);
    if (own < 0 || own >= static_cast<int>(sheet_.materials.size()))
      throw base::InputError("", "Triangle " + std::to_string(t) + " names a material that there is not.");
    const MacroMaterial& material = sheet_.materials[static_cast<std::size_t>(own)];
    const double angle = sheet_.angleOf.empty() ? 0 : sheet_.angleOf.at(index);
    const Eigen::Matrix2d toMaterial = Eigen::Rotation2Dd(-angle).toRotationMatrix();
    mechanics::LimitedTriangle& triangle = triangles_.emplace_back();
    triangle.nodes = sheet_.mesh.triangles[index];
    for (int i = 0; i < 3; ++i) triangle.rest.col(i) = toMaterial * points.col(triangle.nodes[i]).head<2>();
    triangle.stretch = material.stretch;
    triangle.bending = material.bending;
    Eigen::Matrix2d edges;
    edges << triangle.rest.col(1) - triangle.rest.col(0), triangle.rest.col(2) - triangle.rest.col(0);
    areas_[t] = 0.5 * edges.determinant();
    for (const int node : triangle.nodes) masses_[node] += material.density * material.thickness * areas_[t] / 3;
    parts[static_cast<std::size_t>(own)].push_back(triangle.nodes);
  }
  std::vector<mechanics::ShellPanel> panels;
  for (std::size_t m = 0; m < parts.size(); ++m) {
    if (parts[m].empty()) continue;
    const MacroMaterial& material = sheet_.materials[m];
    const mechanics::ShellMaterial shell{
        material.youngModulus, material.poissonRatio, material.density, material.thickness};
    elastic.push_back(mechanics::makeMembrane(3, rest(), parts[m], shell));
    if (auto bending = mechanics::makeHingeBending(rest(), parts[m], shell)) elastic.push_back(std::move(bending));
    panels.push_back({parts[m], rest(), {}, shell, {}, {}});
  }
  if (panels.size() > 1)
    if (auto seams = mechanics::makeSeamBending(panels)) elastic.push_back(std::move(seams));
  const StrainLimitFunction function{options_.limits, 1, options_.margin};
  if (auto stretch = mechanics::makeStretchLimit(triangles_, function)) limits.push_back(std::move(stretch));
  if (auto bending = mechanics::makeCurvatureLimit(triangles_, function)) limits.push_back(std::move(bending));
  elastic_ = assemblerOf(rest(), elastic);
  if (!limits.empty()) limits_ = assemblerOf(rest(), limits);
}

double MacroSimulation::size() const {
  return (sheet_.mesh.points.rowwise().maxCoeff() - sheet_.mesh.points.rowwise().minCoeff()).norm();
}

Eigen::Matrix3Xd MacroSimulation::withBodies(const Vector& positions, const Eigen::Matrix3Xd& bodyPoints) const {
  Eigen::Matrix3Xd all(3, masses_.size() + bodyPoints.cols());
  all << positions.reshaped(3, masses_.size()), bodyPoints;
  return all;
}

std::shared_ptr<mechanics::ContactBarrier> MacroSimulation::contactFrom(const Vector& start,
                                                                        const Eigen::Matrix3Xd& bodyPoints) const {
  constexpr double gravity = 9.81;
  auto contact =
      mechanics::makeSheetContact({sheet_.mesh.triangles, contact_.bodies, contact_.distance, contact_.selfContact},
                                  sheet_.mesh.points, masses_.mean() * gravity);
  if (!contact) return nullptr;
  const Eigen::Matrix3Xd all = withBodies(start, bodyPoints);
  contact->requireFree(all);
  contact->update(all);
  return contact;
}

void MacroSimulation::judgeContact(MacroState& state, mechanics::ContactBarrier* contact,
                                   const Eigen::Matrix3Xd& bodyPoints, const Eigen::Vector3d& up) const {
  if (!contact) return;
  const Eigen::Matrix3Xd all = withBodies(state.positions, bodyPoints);
  contact->update(all);
  state.smallestGap = contact->smallestGap(all);
  state.supported = 0;
  for (const mechanics::Contact& one : contact->contacts()) {
    const auto& bodies = contact->primitives().geometry().bodies;
    const bool first = bodies[static_cast<std::size_t>(one.pair.nodes[0])] == 0;
    const int last = one.pair.nodes[static_cast<std::size_t>(geometry::cornerCount(one.pair.kind) - 1)];
    const bool second = bodies[static_cast<std::size_t>(last)] == 0;
    if (first != second) state.supported += (first ? 1 : -1) * one.force.dot(up);
  }
}

MacroSimulation::Surroundings MacroSimulation::surroundingsOf(const MacroLoads& loads) const {
  Surroundings result;
  result.force = loads.force.size() > 0 ? loads.force : Vector::Zero(3 * masses_.size());
  for (Index node = 0; node < masses_.size(); ++node)
    result.force.segment<3>(3 * node) += masses_[node] * loads.gravity;
  return result;
}

std::vector<char> MacroSimulation::held(const MacroLoads& loads) const {
  std::vector<char> result(static_cast<std::size_t>(masses_.size()), 0);
  for (const int node : loads.clamped) {
    if (node < 0 || node >= masses_.size())
      throw base::InputError("", "Node " + std::to_string(node) + " is clamped, but there is none.");
    result[static_cast<std::size_t>(node)] = 1;
  }
  return result;
}

std::vector<solvers::EnergyMinimizer::Term> MacroSimulation::terms() const {
  std::vector<solvers::EnergyMinimizer::Term> result = {{elastic_, 1}};
  if (limits_) result.push_back({limits_, options_.penalty});
  return result;
}

void MacroSimulation::judge(MacroState& state) const {
  state.strains = mechanics::sheetStrains(triangles_, state.positions);
  const auto count = static_cast<Index>(triangles_.size());
  state.stretchGauge.setZero(count);
  state.bendingGauge.setZero(count);
  state.violation = state.remaining = 0;
  const bool isBarrier = options_.limits == StrainLimitFunction::Kind::barrier;
  for (Index t = 0; t < count; ++t) {
    const auto look = [&](const std::shared_ptr<const AdmissibleStrainSet>& set, const Eigen::Vector3d& strain) {
      if (!set) return 0.0;
      const double g = set->gauge(strain).value, within = g / (1 - options_.margin);
      state.violation = std::max(state.violation, isBarrier ? within - 1 : set->distance(strain).value);
      if (isBarrier) state.remaining += areas_[t] * state.barrier * 2 * within / (1 + within);
      return g;
    };
    const auto& triangle = triangles_[static_cast<std::size_t>(t)];
    state.stretchGauge[t] = look(triangle.stretch, state.strains.stretch.col(t));
    state.bendingGauge[t] = look(triangle.bending, state.strains.curvature.col(t));
  }
}

MacroState MacroSimulation::equilibrium(const MacroLoads& loads, const Vector* start,
                                        base::ExecutionContext& context) const {
  const base::Stopwatch watch;
  const Surroundings surroundings = surroundingsOf(loads);
  solvers::EnergyMinimizer minimizer(terms(), held(loads));
  MacroState state;
  state.positions = start ? *start : rest();
  const Vector from = state.positions;
  const Eigen::Matrix3Xd bodyPoints = mechanics::bodyPointsAt(contact_.bodies, 0);
  const auto contact = contactFrom(from, bodyPoints);
  minimizer.setContact(contact, bodyPoints);
  std::optional<FrictionalRest> rubbing;
  if (contact && contact_.friction > 0)
    rubbing.emplace(minimizer, contact, bodyPoints, masses_, contact_.friction,
                    FrictionalRestOptions{creepOfRest * size(), longestIncrement * size()});
  const bool isBarrier = limits_ && options_.limits == StrainLimitFunction::Kind::barrier;
  state.barrier = isBarrier ? firstBarrier * surroundings.force.reshaped(3, masses_.size()).colwise().norm().sum() *
                                  size() / areas_.sum()
                            : options_.penalty;
  std::vector<base::IterationRecord> records;
  int level = 0;
  for (bool last = !isBarrier;; state.barrier *= barrierDecay) {
    if (limits_) minimizer.setWeight(1, state.barrier);
    solvers::EnergyMinimizerOptions options;
    options.tolerance = last ? options_.tolerance : looseTolerance;
    options.maximumIterations = options_.maximumIterations;
    if (options_.pathSpacing > 0)
      options.visit = [&](const Vector& x) {
        if (state.path.empty() ||
            (x - state.path.back()).reshaped(3, masses_.size()).colwise().norm().maxCoeff() >= options_.pathSpacing)
          state.path.push_back(x);
      };
    state.report = rubbing ? rubbing->settle(state.positions, surroundings, options, context)
                           : minimizer.minimize(state.positions, surroundings, options, context);
    for (base::IterationRecord record : state.report.iterations) {
      record.iteration = static_cast<int>(records.size());
      records.push_back(record);
    }
    judge(state);
    state.work = surroundings.force.dot(state.positions - from);
    if (last || !state.report.converged()) break;
    if (state.remaining <= options_.remaining * std::abs(state.work) || ++level == mostBarriers) {
      last = true;
      state.barrier /= barrierDecay;  // once more with this one, to the tolerance
    }
  }
  judgeContact(state, contact.get(), bodyPoints, -loads.gravity.stableNormalized());
  if (rubbing) {
    state.friction = rubbing->friction();
    state.increments = rubbing->increments();
  }
  state.report.iterations = std::move(records);
  state.report.seconds = watch.seconds();
  return state;
}

}  // namespace pliant::interlock
