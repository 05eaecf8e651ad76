#include "ui/render/figure_layout.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/surface_mesh.hpp"
#include "core/mechanics/mechanism.hpp"

namespace pliant::render {
namespace {

// Sizes as fractions of the model's extent.
constexpr double largestMass = 0.024, smallestMass = 0.008;
constexpr double coilRadius = 0.014;
constexpr int coilTurns = 6;
constexpr double straightEnd = 0.15;  // of a spring's length

/// Σ of the point masses on each node [kg].
std::vector<double> nodeMasses(const mechanics::Model& model, double (*massOf)(const mechanics::PointMass&)) {
  std::vector<double> masses(model.nodeCount(), 0.0);
  for (const mechanics::PointMass& mass : model.pointMasses)
    for (const int node : mass.nodes) masses[node] += massOf(mass);
  return masses;
}

double extentOf(const Points& points) {
  return points.cols() > 0 ? (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm() : 0.0;
}

/// A zigzag in the plane, a helix in space.
int pointsPerTurn(int dimension) { return dimension == 3 ? 12 : 2; }

int coilPoints(int dimension) { return coilTurns * pointsPerTurn(dimension) + 4; }

/// A spring's wire from one end to the other, `coilPoints` of it.
Points coil(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int dimension, double radius) {
  const Eigen::Vector3d axis = to - from;
  const Eigen::Vector3d direction = axis.stableNormalized();
  const Eigen::Vector3d side = direction.cross(
      dimension == 3 && std::abs(direction.z()) > 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d across = std::min(radius, 0.2 * axis.norm()) * side.stableNormalized();
  const Eigen::Vector3d along = direction.cross(across);
  const int perTurn = pointsPerTurn(dimension);
  const int turning = coilTurns * perTurn;
  Points points(3, turning + 4);
  for (int i = 0; i < turning; ++i) {
    const double angle = 2 * std::numbers::pi * i / perTurn;
    points.col(i + 2) = from + (straightEnd + (1 - 2 * straightEnd) * (i + 0.5) / turning) * axis +
                        std::cos(angle) * across + std::sin(angle) * along;
  }
  points.col(0) = from;
  points.col(1) = from + straightEnd * axis;
  points.col(turning + 2) = to - straightEnd * axis;
  points.col(turning + 3) = to;
  return points;
}

double presentMass(const mechanics::PointMass& mass) { return mass.mass; }

double largestMassOf(const mechanics::PointMass& mass) {
  return std::isfinite(mass.maximum) ? std::max(mass.mass, mass.maximum) : mass.mass;
}

}  // namespace

FigureLayout::FigureLayout(const mechanics::Model& model)
    : dimension(model.dimension), rest(toPoints(model.restPositions, model.nodeCount(), model.dimension)) {
  for (const mechanics::DisplayPart& part : model.parts) {
    triangles.insert(triangles.end(), part.triangles.begin(), part.triangles.end());
    links.insert(links.end(), part.segments.begin(), part.segments.end());
    addAttached(part.springs, springs);
    addAttached(part.arms, links);
  }
  for (const geometry::MeshEdge& edge : geometry::meshEdges(triangles))
    if (edge.triangles[0] < 0 || edge.triangles[1] < 0) outline.push_back(edge.nodes);

  const int nodes = model.nodeCount();
  for (int node = 0; node < nodes; ++node) {
    bool locked = !model.lockedCoordinates.empty();
    for (int axis = 0; locked && axis < dimension; ++axis) locked = model.lockedCoordinates[node * dimension + axis];
    if (locked) fixedPoints.push_back(node);
  }
  for (std::size_t i = 0; i < attachments.size(); ++i)
    if (attachments[i].terms.empty()) fixedPoints.push_back(nodes + static_cast<int>(i));
  const int firstCoil = nodes + static_cast<int>(attachments.size());
  const int perCoil = coilPoints(dimension);
  for (int i = 0; i < static_cast<int>(springs.size()) * perCoil; ++i)
    if (i % perCoil > 0) coils.push_back({firstCoil + i - 1, firstCoil + i});
  const Points atRest = places(model.restPositions);
  restExtent_ = extentOf(atRest);
  setReach(atRest);
  drivenNodes = model.drivenNodes();
  for (const mechanics::PointMass& mass : model.pointMasses)
    massNodes.insert(massNodes.end(), mass.nodes.begin(), mass.nodes.end());
  std::sort(massNodes.begin(), massNodes.end());
  massNodes.erase(std::unique(massNodes.begin(), massNodes.end()), massNodes.end());
  for (const mechanics::Probe& probe : model.probes) probeNodes.push_back(probe.node);

  const std::vector<double> largest = nodeMasses(model, largestMassOf);
  if (!largest.empty()) referenceMass_ = std::max(*std::max_element(largest.begin(), largest.end()), 1e-300);
}

void FigureLayout::setReach(const Points& reach) {
  const double extent = restExtent_ > 0 ? restExtent_ : 2.0 * extentOf(reach);
  size = extent > 0 ? extent : 1.0;
}

void FigureLayout::addAttached(const std::vector<std::array<mechanics::AttachmentPoint, 2>>& lines,
                               std::vector<std::array<int, 2>>& ends) {
  for (const auto& line : lines) {
    const int first = static_cast<int>(rest.cols()) + static_cast<int>(attachments.size());
    attachments.insert(attachments.end(), line.begin(), line.end());
    ends.push_back({first, first + 1});
  }
}

Points FigureLayout::places(const Eigen::VectorXd& positions) const {
  const Eigen::Index nodes = rest.cols();
  Points result(3, nodes + static_cast<Eigen::Index>(attachments.size()));
  result.leftCols(nodes) = toPoints(positions, static_cast<int>(nodes), dimension);
  for (std::size_t i = 0; i < attachments.size(); ++i)
    result.col(nodes + static_cast<Eigen::Index>(i)) =
        toPoints(mechanics::positionOf(attachments[i], dimension, positions), 1, dimension);
  return result;
}

Points FigureLayout::pose(const Eigen::VectorXd& positions) const {
  const Points known = places(positions);
  const int perCoil = coilPoints(dimension);
  Points result(3, known.cols() + static_cast<Eigen::Index>(springs.size()) * perCoil);
  result.leftCols(known.cols()) = known;
  for (std::size_t i = 0; i < springs.size(); ++i)
    result.middleCols(known.cols() + static_cast<Eigen::Index>(i) * perCoil, perCoil) =
        coil(known.col(springs[i][0]), known.col(springs[i][1]), dimension, coilRadius * size);
  return result;
}

std::vector<double> FigureLayout::massRadii(const mechanics::Model& model) const {
  const std::vector<double> masses = nodeMasses(model, presentMass);
  std::vector<double> radii;
  for (const int node : massNodes)
    radii.push_back(size * std::max(smallestMass, largestMass * std::cbrt(masses[node] / referenceMass_)));
  return radii;
}

}  // namespace pliant::render
