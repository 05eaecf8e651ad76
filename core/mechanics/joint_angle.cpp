#include "core/mechanics/joint_angle_element.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"
#include "core/mechanics/mechanism.hpp"

namespace pliant::mechanics {

namespace {

/// An element at its rest angle.
template <bool driven>
JointAngleElement<driven> jointAngle(const Vector& rest, int a, int joint, int b, double stiffness,
                                     const std::string& what) {
  const std::array<int, 3> nodes = {a, joint, b};
  requireNodes(nodes, static_cast<int>(rest.size()) / 2, what);
  requireNotNegative(stiffness, what + "'s stiffness");
  const auto component = [&](int node, int axis) { return rest[2 * node + axis] - rest[2 * joint + axis]; };
  const double cross = component(a, 0) * component(b, 1) - component(a, 1) * component(b, 0);
  const double dot = component(a, 0) * component(b, 0) + component(a, 1) * component(b, 1);
  const double product = std::hypot(cross, dot);  // of both lengths
  if (!(product > 0) || a == b)
    throw base::InputError("", what + " needs two links that leave its joint for different nodes");
  return {stiffness, dot / product, cross / product};
}

void requireScalar(const Vector& rest, int scalar, double scalarLength) {
  if (scalar < 0 || scalar >= rest.size())
    throw base::InputError("", "a servo's angle names coordinate " + std::to_string(scalar) + ", but there are " +
                                   std::to_string(rest.size()));
  requirePositive(scalarLength, "the length that a servo's angle is multiplied by");
}

template <int dimension, std::size_t count, std::size_t size>
void fillNodeCoordinates(const std::array<int, count>& nodes, std::array<int, size>& coordinates) {
  for (int i = 0; i < static_cast<int>(count) * dimension; ++i)
    coordinates[i] = dimension * nodes[i / dimension] + i % dimension;
}

}  // namespace

std::shared_ptr<const Energy> makeTorsionSpring(const Vector& restPositions, int a, int joint, int b,
                                                double stiffness) {
  const auto element = jointAngle<false>(restPositions, a, joint, b, stiffness, "a torsion spring");
  std::array<int, 6> coordinates;
  fillNodeCoordinates<2>(std::array{a, joint, b}, coordinates);
  return std::make_shared<ElementEnergy<JointAngleElement<false>>>(std::vector{element}, std::vector{coordinates});
}

std::shared_ptr<const Energy> makeServo(const Vector& restPositions, int a, int joint, int b, double stiffness,
                                        int scalar, double scalarLength) {
  auto element = jointAngle<true>(restPositions, a, joint, b, stiffness, "a servo");
  requireScalar(restPositions, scalar, scalarLength);
  element.scalarLength = scalarLength;
  std::array<int, 7> coordinates;
  fillNodeCoordinates<2>(std::array{a, joint, b}, coordinates);
  coordinates[6] = scalar;
  return std::make_shared<ElementEnergy<JointAngleElement<true>>>(std::vector{element}, std::vector{coordinates});
}

std::shared_ptr<const Energy> makeAxisServo(const Vector& restPositions, int a, int from, int to, int b,
                                            double stiffness, int scalar, double scalarLength) {
  const std::array<int, 4> nodes = {from, to, a, b};
  requireNodes(nodes, static_cast<int>(restPositions.size()) / 3, "a servo");
  requireNotNegative(stiffness, "a servo's stiffness");
  requireScalar(restPositions, scalar, scalarLength);
  const auto arm = [&](int node) -> Eigen::Vector3d {
    return restPositions.segment<3>(3 * node) - restPositions.segment<3>(3 * from);
  };
  const Eigen::Vector3d axis = arm(to), first = axis.cross(arm(a)), second = arm(b).cross(axis);
  if (!(first.norm() > 0 && second.norm() > 0) || a == b)
    throw base::InputError("", "a servo needs two different nodes off its axis, which needs two joints");
  const double restAngle = std::atan2(-axis.norm() * first.dot(arm(b)), first.dot(second));
  const AxisServoElement element{{0.5 * stiffness, restAngle}, scalarLength};
  std::array<int, 13> coordinates;
  fillNodeCoordinates<3>(nodes, coordinates);
  coordinates[12] = scalar;
  return std::make_shared<ElementEnergy<AxisServoElement>>(std::vector{element}, std::vector{coordinates});
}

}  // namespace pliant::mechanics
