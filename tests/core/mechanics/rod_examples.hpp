#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/rod.hpp"

namespace pliant::mechanics {

/// Sections whose bending and torsion are given directly: E = G = density = 1.
inline RodSegment unitSegment(int from, int to, double bending, double torsion, double area) {
  RodSegment segment;
  segment.nodes = {from, to};
  segment.material = {.youngModulus = 1, .shearModulus = 1, .density = 1};
  segment.section = {.area = area,
                     .bendingInertia1 = bending,
                     .bendingInertia2 = bending,
                     .torsionConstant = torsion,
                     .polarInertia = 2 * bending};
  return segment;
}

/// A rod network as a model, with its lumped mass.
struct RodModel {
  Model model;
  std::vector<RodNetwork> network;  ///< one

  RodModel(const Eigen::Matrix3Xd& points, std::vector<RodSegment> segments, const std::vector<int>& framedNodes = {}) {
    model.dimension = 3;
    model.restPositions = points.reshaped();
    network.emplace_back(model.restPositions, std::move(segments), framedNodes, model.coordinateCount());
    model.energies = network[0].energies();
    model.addScalars(network[0].scalarCount());
    std::vector<Eigen::Triplet<double>> entries;
    network[0].addMass(MassMatrix::lumped, entries);
    SparseMatrix mass(model.coordinateCount(), model.coordinateCount());
    mass.setFromTriplets(entries.begin(), entries.end());
    model.elementMass = std::make_shared<const SparseMatrix>(mass);
    model.lockedCoordinates.assign(static_cast<std::size_t>(model.coordinateCount()), 0);
    model.finish();
  }

  /// Holds a node's position and its frame.
  void clamp(int node) {
    for (int axis = 0; axis < 3; ++axis) {
      model.lockedCoordinates[3 * node + axis] = 1;
      model.lockedCoordinates[network[0].frameCoordinates().at(node) + axis] = 1;
    }
    model.finish();
  }

  ElasticAssembler assembler() const { return ElasticAssembler(std::make_shared<const Model>(model)); }
};

/// `count` segments in a row through `count` + 1 nodes that start at `first`.
inline void addChain(std::vector<RodSegment>& segments, const std::vector<int>& nodes, const RodSegment& like) {
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    RodSegment segment = like;
    segment.nodes = {nodes[i], nodes[i + 1]};
    segments.push_back(segment);
  }
}

/// A straight rod along x from the origin, clamped there.
inline RodModel cantilever(double length, int segmentCount, const RodSegment& like) {
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, segmentCount + 1);
  std::vector<RodSegment> segments;
  std::vector<int> nodes;
  for (int n = 0; n <= segmentCount; ++n) {
    points(0, n) = length * n / segmentCount;
    nodes.push_back(n);
  }
  addChain(segments, nodes, like);
  RodModel rod(points, segments, {0});
  rod.clamp(0);
  return rod;
}

/// A circle in the plane z = 0 about the origin, closed.
inline RodModel ring(double radius, int segmentCount, const std::function<RodSegment(const Eigen::Vector3d&)>& like) {
  Eigen::Matrix3Xd points(3, segmentCount);
  for (int n = 0; n < segmentCount; ++n) {
    const double angle = 2 * M_PI * n / segmentCount;
    points.col(n) << radius * std::cos(angle), radius * std::sin(angle), 0;
  }
  std::vector<RodSegment> segments;
  for (int n = 0; n < segmentCount; ++n) {
    const int next = (n + 1) % segmentCount;
    RodSegment segment = like((points.col(next) - points.col(n)).normalized());
    segment.nodes = {n, next};
    segments.push_back(segment);
  }
  return RodModel(points, segments);
}

}  // namespace pliant::mechanics
