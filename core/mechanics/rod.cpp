#include "core/mechanics/rod.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"
#include "core/mechanics/rod_element.hpp"

namespace pliant::mechanics {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

std::array<double, 3> toArray3(const Vector3d& v) { return {v[0], v[1], v[2]}; }

Vector3d edgeVector(const Vector& positions, const std::array<int, 2>& nodes) {
  return positions.segment<3>(3 * nodes[1]) - positions.segment<3>(3 * nodes[0]);
}

void requireSegment(const Vector& restPositions, const RodSegment& segment, const std::string& what) {
  requireNodes(segment.nodes, static_cast<int>(restPositions.size()) / 3, what);
  const double length = edgeVector(restPositions, segment.nodes).norm();
  if (!(length > 0) || !std::isfinite(length)) throw base::InputError("", what + " must have a length above 0");
  requirePositive(segment.material.youngModulus, what + "'s Young's modulus");
  requirePositive(segment.material.shearModulus, what + "'s shear modulus");
  requirePositive(segment.material.density, what + "'s density");
  requirePositive(segment.section.area, what + "'s area");
  requirePositive(segment.section.bendingInertia1, what + "'s second moment of area about director 1");
  requirePositive(segment.section.bendingInertia2, what + "'s second moment of area about director 2");
  requirePositive(segment.section.torsionConstant, what + "'s torsion constant");
  requirePositive(segment.section.polarInertia, what + "'s polar moment of area");
  requireVector(segment.director, 3, what + "'s director");
  requireVector(segment.prestrain, 3, what + "'s prestrain");
}

/// Half a segment's stiffness against turning one end of it by an angle from the other [N m].
Matrix3d halfStiffness(const RodSegment& segment, const Vector3d& edge, const std::string& what) {
  const RodSection& section = segment.section;
  const Vector3d tangent = edge.normalized();
  const Matrix3d along = tangent * tangent.transpose();
  const double young = segment.material.youngModulus, factor = 2 / edge.norm();
  Matrix3d result = segment.material.shearModulus * section.torsionConstant * along;
  if (section.bendingInertia1 == section.bendingInertia2)
    return factor * (result + young * section.bendingInertia1 * (Matrix3d::Identity() - along));
  const Vector3d across = segment.director - along * segment.director;
  if (!(across.norm() > 1e-6 * segment.director.norm()))
    throw base::InputError("", what + " needs a director that does not point along it, as its section is not round");
  const Vector3d director1 = across.normalized(), director2 = tangent.cross(director1);
  result += young * section.bendingInertia1 * director1 * director1.transpose();
  result += young * section.bendingInertia2 * director2 * director2.transpose();
  return factor * result;
}

RotationSpring makeRotationSpring(const Matrix3d& k, const Vector3d& natural) {
  return {{k(0, 0), k(1, 0), k(1, 1), k(2, 0), k(2, 1), k(2, 2)}, toArray3(natural)};
}

template <class Element>
struct ElementList {
  std::vector<Element> elements;
  std::vector<std::array<int, Element::coordinates>> coordinates;

  void addTo(std::vector<std::shared_ptr<const Energy>>& energies) {
    if (!elements.empty())
      energies.push_back(std::make_shared<ElementEnergy<Element>>(std::move(elements), std::move(coordinates)));
  }
};

}  // namespace

/// The half of a segment that is next to a node, seen from the node outwards.
struct RodNetwork::HalfSegment {
  int segment;
  int farNode;
  RodEdge edge;
  Matrix3d stiffness;
  Vector3d natural;  ///< by how much more its middle would turn, relative to the node, if it were free [rad]
};

RodNetwork::RodNetwork(const Vector& restPositions, std::vector<RodSegment> segments,
                       const std::vector<int>& framedNodes, int firstScalar)
    : restPositions_(restPositions), segments_(std::move(segments)), firstScalar_(firstScalar) {
  if (segments_.empty()) throw base::InputError("", "a rod network needs at least one segment");
  std::map<int, int> degrees;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    requireSegment(restPositions_, segments_[i], "the rod segment " + std::to_string(i));
    for (const int node : segments_[i].nodes) ++degrees[node];
  }
  for (const auto& [node, degree] : degrees)
    if (degree > 2) frames_[node] = 0;
  for (const int node : framedNodes) {
    if (degrees.count(node) == 0)
      throw base::InputError("", "node " + std::to_string(node) + " cannot have a frame, as no rod ends there");
    frames_[node] = 0;
  }
  int coordinate = firstScalar_ + static_cast<int>(segments_.size());
  for (auto& frame : frames_) {
    frame.second = coordinate;
    coordinate += 3;
  }
  halves();  // checks the directors
}

int RodNetwork::scalarCount() const { return static_cast<int>(segments_.size() + 3 * frames_.size()); }

double RodNetwork::twistLength(int segment) const {
  const RodSection& section = segments_[segment].section;
  return std::sqrt(section.polarInertia / section.area);
}

double RodNetwork::frameLength(int node) const {
  double length = 0;
  for (std::size_t i = 0; i < segments_.size(); ++i)
    if (segments_[i].nodes[0] == node || segments_[i].nodes[1] == node)
      length = std::max(length, twistLength(static_cast<int>(i)));
  return length;
}

double RodNetwork::restLength(int segment) const { return edgeVector(restPositions_, segments_[segment].nodes).norm(); }

std::map<int, std::vector<RodNetwork::HalfSegment>> RodNetwork::halves() const {
  std::map<int, std::vector<HalfSegment>> result;
  for (int i = 0; i < static_cast<int>(segments_.size()); ++i) {
    const RodSegment& segment = segments_[i];
    const Vector3d edge = edgeVector(restPositions_, segment.nodes);
    const Matrix3d stiffness = halfStiffness(segment, edge, "the rod segment " + std::to_string(i));
    for (int end = 0; end < 2; ++end) {
      const double sign = end == 0 ? 1 : -1;
      result[segment.nodes[end]].push_back(
          {i,
           segment.nodes[1 - end],
           {toArray3(sign * edge.normalized()), edge.norm(), sign / (2 * twistLength(i))},
           stiffness,
           sign * edge.norm() / 2 * segment.prestrain});
    }
  }
  return result;
}

std::vector<std::shared_ptr<const Energy>> RodNetwork::energies() const {
  ElementList<RodStretchElement> stretch;
  for (int i = 0; i < static_cast<int>(segments_.size()); ++i) {
    const auto& [nodes, material, section, director, prestrain] = segments_[i];
    const double length = restLength(i);
    stretch.elements.push_back({material.youngModulus * section.area / length, length});
    auto& coordinates = stretch.coordinates.emplace_back();
    for (int c = 0; c < 6; ++c) coordinates[c] = 3 * nodes[c / 3] + c % 3;
  }
  ElementList<RodBendElement> bend;
  ElementList<RodJointElement> joint;
  for (const auto& [node, halfSegments] : halves()) {
    if (const auto frame = frames_.find(node); frame != frames_.end()) {
      for (const HalfSegment& half : halfSegments) {
        joint.elements.push_back(
            {half.edge, 1 / (4 * frameLength(node)), makeRotationSpring(half.stiffness, -half.natural)});
        auto& coordinates = joint.coordinates.emplace_back();
        for (int c = 0; c < 3; ++c) {
          coordinates[c] = 3 * node + c;
          coordinates[3 + c] = 3 * half.farNode + c;
          coordinates[7 + c] = frame->second + c;
        }
        coordinates[6] = twistCoordinate(half.segment);
      }
    } else if (halfSegments.size() == 2) {
      const HalfSegment &before = halfSegments[0], &after = halfSegments[1];
      RodEdge towards = before.edge;  // walked from its far end to the node
      for (double& component : towards.restTangent) component = -component;
      towards.halfAngle = -towards.halfAngle;
      const Matrix3d series = before.stiffness * (before.stiffness + after.stiffness).inverse() * after.stiffness;
      bend.elements.push_back(
          {towards, after.edge,
           makeRotationSpring(0.5 * (series + series.transpose()), after.natural - before.natural)});
      auto& coordinates = bend.coordinates.emplace_back();
      for (int c = 0; c < 3; ++c) {
        coordinates[c] = 3 * before.farNode + c;
        coordinates[3 + c] = 3 * node + c;
        coordinates[6 + c] = 3 * after.farNode + c;
      }
      coordinates[9] = twistCoordinate(before.segment);
      coordinates[10] = twistCoordinate(after.segment);
    }
  }
  std::vector<std::shared_ptr<const Energy>> result;
  stretch.addTo(result);
  bend.addTo(result);
  joint.addTo(result);
  return result;
}

void RodNetwork::addMass(MassMatrix kind, std::vector<Eigen::Triplet<double>>& entries) const {
  for (int i = 0; i < static_cast<int>(segments_.size()); ++i) {
    const RodSegment& segment = segments_[i];
    const double line = segment.material.density * restLength(i), mass = line * segment.section.area;
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) {
        if (kind == MassMatrix::lumped && a != b) continue;
        const double share = kind == MassMatrix::lumped ? mass / 2 : mass / (a == b ? 3 : 6);
        for (int axis = 0; axis < 3; ++axis)
          entries.emplace_back(3 * segment.nodes[a] + axis, 3 * segment.nodes[b] + axis, share);
      }
    const double inertia = line * segment.section.polarInertia;
    double own = inertia;
    for (const int node : segment.nodes) {
      const auto frame = frames_.find(node);
      if (frame == frames_.end()) continue;
      own -= inertia / 4;
      const double share = inertia / 4 / std::pow(frameLength(node), 2);
      for (int axis = 0; axis < 3; ++axis) entries.emplace_back(frame->second + axis, frame->second + axis, share);
    }
    entries.emplace_back(twistCoordinate(i), twistCoordinate(i), own / std::pow(twistLength(i), 2));
  }
}

std::optional<double> largestTurn(const Model& model, const Vector& positions) {
  std::optional<double> largest;
  for (const auto& energy : model.energies) {
    const auto* stretch = dynamic_cast<const ElementEnergy<RodStretchElement>*>(energy.get());
    for (int e = 0; stretch && e < stretch->elementCount(); ++e) {  // one a segment
      const auto coordinates = stretch->elementCoordinates(e);
      const std::array<int, 2> nodes{coordinates[0] / 3, coordinates[3] / 3};
      const Vector3d rest = edgeVector(model.restPositions, nodes), now = edgeVector(positions, nodes);
      largest = std::max(largest.value_or(0), std::atan2(rest.cross(now).norm(), rest.dot(now)));
    }
  }
  return largest;
}

}  // namespace pliant::mechanics
