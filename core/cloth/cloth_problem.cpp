#include "core/cloth/cloth_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace pliant::cloth {

using base::InputError;

namespace {

/// Times that differ by less are the same [s].
constexpr double sameTime = 1e-9;

bool holds(const Pin& pin, double time) { return !pin.release || time <= *pin.release + sameTime; }

void checkModelKind(const mechanics::Model& model) {
  if (model.dimension != 3) throw InputError("", "cloth studies need a scene of dimension 3");
  if (model.scalarCount > 0) throw InputError("", "cloth studies know neither rods nor servos");
  if (!model.drives.empty())
    throw InputError("", "cloth studies know no periodic drives; nodes are moved by a boundary condition \"pin\"");
  for (const mechanics::HarmonicForce& force : model.forces)
    for (const auto& term : force.signal.terms)
      if (term.order != 0)
        throw InputError("", "cloth studies know only forces that are constant, with harmonics of order 0, but '" +
                                 force.name + "' swings");
}

void checkMasses(const mechanics::Model& model, const std::vector<char>& held) {
  const mechanics::SparseMatrix mass = model.massMatrix();
  for (Eigen::Index column = 0; column < mass.cols(); ++column)
    for (mechanics::SparseMatrix::InnerIterator it(mass, column); it; ++it)
      if (it.row() != column && it.value() != 0)
        throw InputError("", "cloth studies need masses that act on the nodes alone: \"mass_matrix\": \"lumped\"");
  for (int node = 0; node < model.nodeCount(); ++node)
    if (!held[static_cast<std::size_t>(node)] && !(mass.coeff(3 * node, 3 * node) > 0))
      throw InputError("", "node " + std::to_string(node) + " can move but has no mass");
}

}  // namespace

Eigen::Vector3d Wind::velocityAt(double time) const {
  return (1 + gust * std::sin(2 * std::numbers::pi * time / gustPeriod)) * velocity;
}

void checkClothProblem(const ClothProblem& problem) {
  const mechanics::Model& model = *problem.model;
  checkModelKind(model);
  const int nodes = model.nodeCount();
  for (int node = 0; node < nodes; ++node) {
    const auto first = model.lockedCoordinates.begin() + 3 * node;
    const auto locked = std::count(first, first + 3, 1);
    if (locked != 0 && locked != 3)
      throw InputError("", "cloth studies need all three coordinates of a node locked, or none, but of node " +
                               std::to_string(node) + " there are " + std::to_string(locked));
  }
  std::vector<char> held = lockedNodes(model);
  for (const Pin& pin : problem.pins)
    for (const int node : pin.nodes) {
      if (node < 0 || node >= nodes)
        throw InputError("", "the pin '" + pin.name + "' names node " + std::to_string(node) + ", but there are " +
                                 std::to_string(nodes));
      if (!pin.release) held[static_cast<std::size_t>(node)] = 1;
    }
  checkMasses(model, held);
  if (problem.sheet.nodeCount != nodes)
    throw InputError("", "the sheet has " + std::to_string(problem.sheet.nodeCount) + " nodes, but the model has " +
                             std::to_string(nodes));
}

Eigen::Matrix3Xd pinnedPositions(const ClothProblem& problem, const Pin& pin, double time) {
  const auto rest = problem.model->restPositions.reshaped(3, problem.model->nodeCount());
  Eigen::Matrix3Xd points = rest(Eigen::all, pin.nodes);
  if (pin.path.empty()) return points;
  return placementAt(pin.path, time).apply(points, points.rowwise().mean());
}

std::vector<char> lockedNodes(const mechanics::Model& model) {
  std::vector<char> locked(static_cast<std::size_t>(model.nodeCount()));
  for (std::size_t node = 0; node < locked.size(); ++node) locked[node] = model.lockedCoordinates[3 * node];
  return locked;
}

std::vector<char> heldNodes(const ClothProblem& problem, double time) {
  std::vector<char> held = lockedNodes(*problem.model);
  for (const Pin& pin : problem.pins)
    if (holds(pin, time))
      for (const int node : pin.nodes) held[static_cast<std::size_t>(node)] = 1;
  return held;
}

void placePins(const ClothProblem& problem, double time, Eigen::Matrix3Xd& positions) {
  for (const Pin& pin : problem.pins)
    if (holds(pin, time)) positions(Eigen::all, pin.nodes) = pinnedPositions(problem, pin, time);
}

bool hasLimits(const LimitedSheet& sheet) {
  return std::any_of(sheet.triangles.begin(), sheet.triangles.end(),
                     [](const SheetTriangle& triangle) { return triangle.limit >= 0; });
}

Energies energiesAt(const ClothProblem& problem, const Eigen::Matrix3Xd& positions,
                    const Eigen::Matrix3Xd& velocities) {
  const mechanics::Model& model = *problem.model;
  Energies energies;
  energies.kinetic = 0.5 * velocities.colwise().squaredNorm() * lumpedMasses(model);
  energies.gravity = -model.externalForce(0).dot(positions.reshaped() - model.restPositions);
  for (const auto& energy : model.energies) {
    double value = 0;
    mechanics::EvaluationBlock<double> block;
    block.x = positions.data();
    block.value = &value;
    energy->accumulate(block);
    (energy->name() == "membrane"        ? energies.membrane
     : energy->name() == "hinge_bending" ? energies.bending
                                         : energies.other) += value;
  }
  return energies;
}

Eigen::VectorXd lumpedMasses(const mechanics::Model& model) {
  const mechanics::Vector diagonal = model.massMatrix().diagonal();
  return diagonal(Eigen::seqN(0, model.nodeCount(), 3));
}

}  // namespace pliant::cloth
