#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/mechanics/model.hpp"
#include "core/mechanics/shell.hpp"
#include "core/mechanics/spring.hpp"

namespace pliant::mechanics {

/// Force per relative change of length of rigid links (thesis 2.5.5) unless another is chosen [N]: a hundred newtons
/// stretch a link by 1e-3 %.
inline constexpr double rigidLinkStiffness = 1e7;

/// A rigid bar through some joints, as stiff penalties (`stiffness` K [N]):
///  - two joints: their distance (RigidLinkElement);
///  - more joints in the plane: the distance of the two farthest from one another, and each other joint at its place in
///    the frame of those two (RigidJointElement, linear in the positions);
///  - in space: all distances between joints that span the bar (two where all are in line, three in a plane, else
///    four), and each other joint as the affine combination of them that it is at rest. Joints may be in line, or
///    off it by a hundredth of the bar's length; in between distances would hardly resist.
/// A rigid angle between two links is a bar through their three joints. Throws base::InputError.
std::vector<std::shared_ptr<const Energy>> makeRigidBar(int dimension, const Vector& restPositions,
                                                        const std::vector<int>& joints,
                                                        double stiffness = rigidLinkStiffness);

/// Adds the mass [kg] of a bar that is uniform along the line through its joints, in their order: consistent (exact for
/// a rigid bar, moment of inertia included) or half of each piece on its two joints. Throws base::InputError.
void addBarMass(int dimension, const Vector& restPositions, const std::vector<int>& joints, double mass,
                MassMatrix kind, std::vector<Eigen::Triplet<double>>& entries);

/// Where springs can be attached: a node, a fixed place.
AttachmentPoint attachedToNode(int dimension, int node);
AttachmentPoint fixedPlace(const Vector& place);
/// In the local coordinates of the link from joint a to joint b [m]: `along` from a towards b, `across` to the left of
/// it (0 in 3 dimensions). Throws base::InputError.
AttachmentPoint attachedToLink(int dimension, const Vector& restPositions, int a, int b, double along, double across);
/// Where such a point is [m].
Vector positionOf(const AttachmentPoint& point, int dimension, const Vector& positions);

/// A spring between two such points (thesis 2.A.5); e = distance - restLength [m]. Throws base::InputError.
std::shared_ptr<const Energy> makeLocalSpring(int dimension, const AttachmentPoint& from, const AttachmentPoint& to,
                                              double restLength, const SpringLaw& law);

/// A torsion spring [N m/rad] in the plane at `joint`, between the links from there to nodes a and b; without moment at
/// rest (JointAngleElement). With a stiffness like a rigid link's it is a rigid angle. Throws base::InputError.
std::shared_ptr<const Energy> makeTorsionSpring(const Vector& restPositions, int a, int joint, int b, double stiffness);

/// A servo of the stiffness k [N m/rad] in the plane at `joint`: a torsion spring without moment where the link from
/// there to b has turned by the angle `scalar` / `scalarLength` against the link to a. `scalar` is the index of a
/// scalar coordinate [m] (Model::scalarCount), driven as a rule. Throws base::InputError.
std::shared_ptr<const Energy> makeServo(const Vector& restPositions, int a, int joint, int b, double stiffness,
                                        int scalar, double scalarLength);

/// A servo in space that turns node b against node a about the axis through the joints `from` and `to`, right-handed.
std::shared_ptr<const Energy> makeAxisServo(const Vector& restPositions, int a, int from, int to, int b,
                                            double stiffness, int scalar, double scalarLength);

/// The largest relative violation of any rigid link or joint at `positions`: a link's change of length over its length,
/// a joint's distance from its place in a bar over the bar's length. None if the model has no such constraint.
std::optional<double> constraintViolation(const Model& model, const Vector& positions);

}  // namespace pliant::mechanics
