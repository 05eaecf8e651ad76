#include "core/mechanics/model.hpp"

#include <algorithm>
#include <set>

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"

namespace pliant::mechanics {

namespace {

std::string quoted(const char* kind, const std::string& name) { return std::string(kind) + " '" + name + "'"; }

void checkSizes(const Model& model) {
  requireDimension(model.dimension, "the model");
  const int count = model.coordinateCount();
  const int nodal = count - model.scalarCount;
  if (model.scalarCount < 0 || nodal <= 0 || nodal % model.dimension != 0)
    throw base::InputError("", "the model must have at least one node, and " + std::to_string(model.dimension) +
                                   " coordinates for each, but has " + std::to_string(nodal) + " coordinates");
  requireVector(model.restPositions, count, "the rest positions");
  requireVector(model.gravity, model.dimension, "gravity");
  requireNotNegative(model.massDamping, "the mass damping");
  requireNotNegative(model.stiffnessDamping, "the stiffness damping");
  if (model.elementMass && (model.elementMass->rows() != count || model.elementMass->cols() != count))
    throw base::InputError("", "the element mass matrix must have a row and a column for each of the " +
                                   std::to_string(count) + " coordinates");
  if (static_cast<int>(model.lockedCoordinates.size()) != count)
    throw base::InputError(
        "", "the locked coordinates must be given for each of the " + std::to_string(count) + " coordinates");
}

/// "node 3" or "scalar coordinate 3".
std::string ownerOf(const Model& model, int coordinate) {
  const int nodal = model.nodeCount() * model.dimension;
  return coordinate < nodal ? "node " + std::to_string(coordinate / model.dimension)
                            : "scalar coordinate " + std::to_string(coordinate - nodal);
}

void requireCoordinate(const Model& model, int coordinate, const std::string& what) {
  if (coordinate >= 0 && coordinate < model.coordinateCount()) return;
  const bool nodal = coordinate < 0 || model.scalarCount == 0;
  throw base::InputError(
      "", what + " names " +
              (nodal ? "node " + std::to_string(coordinate / model.dimension) + ", but there are " +
                           std::to_string(model.nodeCount()) + " nodes"
                     : ownerOf(model, coordinate) + ", but there are " + std::to_string(model.scalarCount)));
}

void checkParts(const Model& model) {
  const int nodes = model.nodeCount();
  for (const PointMass& mass : model.pointMasses) {
    const std::string what = quoted("point mass", mass.name);
    requireNodes(mass.nodes, nodes, what);
    requireNotNegative(mass.mass, what);
    requireNotNegative(mass.minimum, what + "'s lower bound");
    requireNotNegative(mass.maximum, what + "'s upper bound");
  }
  for (const HarmonicForce& force : model.forces) {
    const std::string what = quoted("force", force.name);
    requireNodes(force.nodes, nodes, what);
    requireVector(force.direction, model.dimension, what + "'s direction");
    requireSignal(force.signal, what);
  }
  for (const Probe& probe : model.probes) requireNodes(std::span(&probe.node, 1), nodes, quoted("probe", probe.name));
  for (const auto& energy : model.energies)
    for (int e = 0; e < energy->elementCount(); ++e)
      for (const int coordinate : energy->elementCoordinates(e))
        requireCoordinate(model, coordinate, "element " + std::to_string(e) + " of the " + std::string(energy->name()));
}

DofMap mapUnknowns(const Model& model) {
  std::vector<char> fixed = model.lockedCoordinates;
  std::vector<char> driven(model.coordinateCount(), 0);
  for (const auto& drive : model.drives)
    for (const int coordinate : drive->coordinates()) {
      requireCoordinate(model, coordinate, "a prescribed motion");
      if (driven[coordinate]) throw base::InputError("", ownerOf(model, coordinate) + " is driven more than once");
      if (model.lockedCoordinates[coordinate])
        throw base::InputError("", ownerOf(model, coordinate) + " is both driven and locked");
      driven[coordinate] = fixed[coordinate] = 1;
    }
  DofMap map;
  map.freeIndex.assign(model.coordinateCount(), -1);
  for (int coordinate = 0; coordinate < model.coordinateCount(); ++coordinate) {
    if (fixed[coordinate]) continue;
    map.freeIndex[coordinate] = map.freeCount();
    map.freeCoordinates.push_back(coordinate);
  }
  if (map.freeCount() == 0)
    throw base::InputError("", "every coordinate is driven or locked, so that nothing is left to compute");
  return map;
}

}  // namespace

int Model::addScalars(int count) {
  const int first = coordinateCount();
  restPositions.conservativeResize(first + count);
  restPositions.tail(count).setZero();
  if (!lockedCoordinates.empty()) lockedCoordinates.resize(first + count, 0);
  scalarCount += count;
  return first;
}

void Model::finish() {
  if (gravity.size() == 0) gravity = Vector::Zero(dimension);
  if (lockedCoordinates.empty()) lockedCoordinates.assign(coordinateCount(), 0);
  checkSizes(*this);
  checkParts(*this);
  dofs = mapUnknowns(*this);
}

SparseMatrix Model::massMatrix() const {
  SparseMatrix points(coordinateCount(), coordinateCount());
  std::vector<Eigen::Triplet<double>> entries;
  for (const PointMass& mass : pointMasses)
    for (const int node : mass.nodes)
      for (int axis = 0; axis < dimension; ++axis)
        entries.emplace_back(node * dimension + axis, node * dimension + axis, mass.mass);
  points.setFromTriplets(entries.begin(), entries.end());
  return elementMass ? SparseMatrix(*elementMass + points) : points;
}

Vector Model::externalForce(math::Phases phases) const {
  Vector force = Vector::Zero(coordinateCount());
  if (!gravity.isZero(0)) {
    if (elementMass) {
      Vector acceleration = Vector::Zero(coordinateCount());
      acceleration.head(nodeCount() * dimension) = gravity.replicate(nodeCount(), 1);
      force += *elementMass * acceleration;
    }
    for (const PointMass& mass : pointMasses)
      for (const int node : mass.nodes) force.segment(node * dimension, dimension) += mass.mass * gravity;
  }
  for (const HarmonicForce& load : forces) {
    const Vector value = load.signal(phases) * load.direction;
    for (const int node : load.nodes) force.segment(node * dimension, dimension) += value;
  }
  return force;
}

Vector Model::configuration(const Vector& free, math::Phases phases) const {
  Vector x = restPositions;
  for (int i = 0; i < dofs.freeCount(); ++i) x[dofs.freeCoordinates[i]] = free[i];
  for (const auto& drive : drives) x(drive->coordinates()) = drive->values(restPositions(drive->coordinates()), phases);
  return x;
}

bool Model::hasSecondFrequency() const {
  const auto has = [](const PeriodicSignal& signal) {
    return std::any_of(
        signal.terms.begin(), signal.terms.end(), [](const auto& term) { return term.ofSecondFrequency; });
  };
  return std::any_of(drives.begin(), drives.end(), [&](const auto& drive) { return has(drive->signal()); }) ||
         std::any_of(forces.begin(), forces.end(), [&](const auto& force) { return has(force.signal); });
}

std::vector<int> Model::drivenNodes() const {
  std::set<int> nodes;
  for (const auto& drive : drives)
    for (const int coordinate : drive->coordinates())
      if (coordinate < nodeCount() * dimension) nodes.insert(coordinate / dimension);
  return {nodes.begin(), nodes.end()};
}

}  // namespace pliant::mechanics
