#include <Eigen/Dense>
#include <algorithm>
#include <set>

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"
#include "core/mechanics/mechanism.hpp"
#include "core/mechanics/mechanism_elements.hpp"

namespace pliant::mechanics {

namespace {

constexpr double inLine = 1e-6;      ///< of the bar's length: joints nearer to the line are on it
constexpr double clearlyOff = 0.01;  ///< of the bar's length

void requireJoints(int dimension, const Vector& rest, const std::vector<int>& joints) {
  requireDimension(dimension, "a rigid bar");
  requireNodes(joints, static_cast<int>(rest.size()) / dimension, "a rigid bar");
  if (joints.size() < 2) throw base::InputError("", "a rigid bar must have at least two joints");
  if (std::set<int>(joints.begin(), joints.end()).size() != joints.size())
    throw base::InputError("", "a rigid bar must not have a joint twice");
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (rest.segment(joints[i] * dimension, dimension) == rest.segment(joints[j] * dimension, dimension))
        throw base::InputError("", "a rigid bar must not have two joints at one place, as nodes " +
                                       std::to_string(joints[j]) + " and " + std::to_string(joints[i]));
}

/// The joints, those that span the bar in front, and how many these are.
struct BarFrame {
  std::vector<int> joints;
  int spanning = 2;
  double length = 0;  ///< between the first two
};

/// Puts the joint that is farthest from the affine hull of the first `count` in the place behind them.
double bringFarthestForward(int dimension, const Vector& rest, std::vector<int>& joints, int count) {
  const auto point = [&](std::size_t i) -> Vector { return rest.segment(joints[i] * dimension, dimension); };
  Matrix span(dimension, count - 1);
  for (int k = 1; k < count; ++k) span.col(k - 1) = point(static_cast<std::size_t>(k)) - point(0);
  std::size_t farthest = static_cast<std::size_t>(count);
  double largest = -1;
  for (std::size_t i = static_cast<std::size_t>(count); i < joints.size(); ++i) {
    const Vector arm = point(i) - point(0);
    const double distance = (arm - span * span.colPivHouseholderQr().solve(arm)).norm();
    if (distance > largest) {
      largest = distance;
      farthest = i;
    }
  }
  if (farthest < joints.size()) std::swap(joints[static_cast<std::size_t>(count)], joints[farthest]);
  return largest;
}

BarFrame frameOf(int dimension, const Vector& rest, const std::vector<int>& joints) {
  const auto distance = [&](int a, int b) {
    return (rest.segment(a * dimension, dimension) - rest.segment(b * dimension, dimension)).norm();
  };
  BarFrame frame{joints};
  std::pair<std::size_t, std::size_t> ends(0, 1);
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (std::size_t j = i + 1; j < joints.size(); ++j)
      if (distance(joints[i], joints[j]) > distance(joints[ends.first], joints[ends.second])) ends = {i, j};
  std::swap(frame.joints[0], frame.joints[ends.first]);
  std::swap(frame.joints[1], frame.joints[ends.second]);
  frame.length = distance(frame.joints[0], frame.joints[1]);
  if (dimension < 3) return frame;
  while (frame.spanning < 4 && frame.spanning < static_cast<int>(joints.size())) {
    const double off = bringFarthestForward(dimension, rest, frame.joints, frame.spanning);
    if (off <= inLine * frame.length) break;
    if (off < clearlyOff * frame.length)
      throw base::InputError(
          "", "joint " + std::to_string(frame.joints[static_cast<std::size_t>(frame.spanning)]) +
                  " of a rigid bar must lie in line (or in a plane) with the others, or off it by at least a "
                  "hundredth of the bar's length");
    ++frame.spanning;
  }
  return frame;
}

template <int dimension>
std::shared_ptr<const Energy> lengthsOf(const Vector& rest, const BarFrame& frame, double stiffness) {
  std::vector<RigidLinkElement<dimension>> elements;
  std::vector<std::array<int, 2 * dimension>> coordinates;
  for (int i = 1; i < frame.spanning; ++i)
    for (int j = 0; j < i; ++j) {
      const int a = frame.joints[static_cast<std::size_t>(j)], b = frame.joints[static_cast<std::size_t>(i)];
      const double length = (rest.segment<dimension>(b * dimension) - rest.segment<dimension>(a * dimension)).norm();
      elements.push_back({stiffness, length});
      auto& indices = coordinates.emplace_back();
      for (int axis = 0; axis < dimension; ++axis) {
        indices[axis] = a * dimension + axis;
        indices[dimension + axis] = b * dimension + axis;
      }
    }
  return std::make_shared<ElementEnergy<RigidLinkElement<dimension>>>(std::move(elements), std::move(coordinates));
}

/// The spanning joints and then the joint, with the combination that vanishes at rest.
template <int dimension, int n>
NodeCombination<dimension, n> restCombination(const Vector& rest, const std::array<int, n>& joints) {
  const auto point = [&](int i) -> Vector { return rest.segment<dimension>(joints[i] * dimension); };
  NodeCombination<dimension, n> r;
  r.weights[n - 1] = 1;
  const Vector arm = point(n - 1) - point(0);
  Matrix span(dimension, n - 2);
  for (int k = 1; k < n - 1; ++k) span.col(k - 1) = point(k) - point(0);
  if constexpr (dimension == 2) {
    const double t = (span(0, 0) * arm[1] - span(1, 0) * arm[0]) / span.squaredNorm();
    r.turnedWeights[0] = t;
    r.turnedWeights[1] = -t;
  }
  const Vector weights = span.colPivHouseholderQr().solve(arm);
  r.weights[0] = weights.sum() - 1;
  for (int k = 1; k < n - 1; ++k) r.weights[k] = -weights[k - 1];
  return r;
}

template <int dimension, int n>
std::shared_ptr<const Energy> placesOf(const Vector& rest, const BarFrame& frame, double stiffness) {
  std::vector<RigidJointElement<dimension, n>> elements;
  std::vector<std::array<int, n * dimension>> coordinates;
  for (std::size_t i = n - 1; i < frame.joints.size(); ++i) {
    std::array<int, n> joints;
    std::copy_n(frame.joints.begin(), n - 1, joints.begin());
    joints[n - 1] = frame.joints[i];
    elements.push_back({restCombination<dimension, n>(rest, joints), stiffness, frame.length});
    auto& indices = coordinates.emplace_back();
    for (int k = 0; k < n * dimension; ++k) indices[k] = joints[k / dimension] * dimension + k % dimension;
  }
  return std::make_shared<ElementEnergy<RigidJointElement<dimension, n>>>(std::move(elements), std::move(coordinates));
}

}  // namespace

std::vector<std::shared_ptr<const Energy>> makeRigidBar(int dimension, const Vector& restPositions,
                                                        const std::vector<int>& joints, double stiffness) {
  requireJoints(dimension, restPositions, joints);
  requirePositive(stiffness, "a rigid bar's stiffness");
  const BarFrame frame = frameOf(dimension, restPositions, joints);
  std::vector<std::shared_ptr<const Energy>> energies = {dimension == 1 ? lengthsOf<1>(restPositions, frame, stiffness)
                                                         : dimension == 2
                                                             ? lengthsOf<2>(restPositions, frame, stiffness)
                                                             : lengthsOf<3>(restPositions, frame, stiffness)};
  if (static_cast<int>(joints.size()) > frame.spanning)
    energies.push_back(dimension == 1        ? placesOf<1, 3>(restPositions, frame, stiffness)
                       : dimension == 2      ? placesOf<2, 3>(restPositions, frame, stiffness)
                       : frame.spanning == 2 ? placesOf<3, 3>(restPositions, frame, stiffness)
                       : frame.spanning == 3 ? placesOf<3, 4>(restPositions, frame, stiffness)
                                             : placesOf<3, 5>(restPositions, frame, stiffness));
  return energies;
}

void addBarMass(int dimension, const Vector& restPositions, const std::vector<int>& joints, double mass,
                MassMatrix kind, std::vector<Eigen::Triplet<double>>& entries) {
  requireJoints(dimension, restPositions, joints);
  requireNotNegative(mass, "a bar's mass");
  const auto length = [&](std::size_t i) {
    return (restPositions.segment(joints[i] * dimension, dimension) -
            restPositions.segment(joints[i - 1] * dimension, dimension))
        .norm();
  };
  double total = 0;
  for (std::size_t i = 1; i < joints.size(); ++i) total += length(i);
  for (std::size_t i = 1; i < joints.size(); ++i) {
    const double piece = mass * length(i) / total;
    for (const std::size_t a : {i - 1, i})
      for (const std::size_t b : {i - 1, i}) {
        if (kind == MassMatrix::lumped && a != b) continue;
        const double share = kind == MassMatrix::lumped ? piece / 2 : piece / (a == b ? 3 : 6);
        for (int axis = 0; axis < dimension; ++axis)
          entries.emplace_back(joints[a] * dimension + axis, joints[b] * dimension + axis, share);
      }
  }
}

std::optional<double> constraintViolation(const Model& model, const Vector& positions) {
  std::optional<double> largest;
  for (const auto& energy : model.energies)
    if (const std::optional<double> violation = energy->constraintViolation(positions.data()))
      largest = std::max(largest.value_or(0), *violation);
  return largest;
}

}  // namespace pliant::mechanics
