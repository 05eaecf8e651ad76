#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "core/mechanics/model.hpp"
#include "core/mechanics/shell.hpp"

namespace pliant::mechanics {

struct RodMaterial {
  double youngModulus = 0;  ///< E [Pa]
  double shearModulus = 0;  ///< G [Pa]
  double density = 0;       ///< [kg/m³]
};

/// Of a rod's section, with respect to two directors across the rod.
struct RodSection {
  double area = 0;             ///< [m²]
  double bendingInertia1 = 0;  ///< second moment of area for bending about director 1 [m⁴]
  double bendingInertia2 = 0;  ///< about director 2 [m⁴]
  double torsionConstant = 0;  ///< J: torque = G J * twist rate [m⁴]
  double polarInertia = 0;     ///< bendingInertia1 + bendingInertia2 unless the rod carries other mass [m⁴]
};

/// Each throws base::InputError unless lengths are above 0.
RodSection circularSection(double radius);
/// Throws as well unless innerRadius is at least 0 and below the radius.
RodSection tubularSection(double radius, double innerRadius);
/// `width` along director 1, `height` along director 2; J from Saint-Venant's series, to rounding.
RodSection rectangularSection(double width, double height);

/// A straight piece of rod between two nodes.
struct RodSegment {
  std::array<int, 2> nodes;
  RodMaterial material;
  RodSection section;
  /// Director 1 at rest is this without its part along the segment; of no account if both bending inertias are equal.
  Eigen::Vector3d director = Eigen::Vector3d::Zero();
  /// What the segment would do if it were free: sections turn by this more per length than in the rest shape, seen
  /// along the segment from its first node, in the rest shape's coordinates [1/m]. Zero: the rest shape is unstressed.
  Eigen::Vector3d prestrain = Eigen::Vector3d::Zero();
};

/// Discrete elastic rods (Bergou et al. 2008, 2010) and networks of them, in 3 dimensions.
///
/// Scalar coordinates beside the nodes' positions: the twist of each segment, its angle times `twistLength` (the polar
/// radius of gyration, so that its inertia is the segment's mass); and for each *frame*, three: a rigid joint that
/// turns with the node, its rotation from rest as 4 `frameLength` times the modified Rodrigues vector (axis times
/// tan(angle/4): about the rotation vector). Nodes where three or more segments meet have a frame, and so has every
/// node that is asked for, to clamp or to drive it.
///
/// Material frames depend on the configuration alone: an edge's is its rest frame, turned by the twist about the rest
/// tangent and then by the smallest rotation that brings the rest tangent to the edge. That is singular where an edge
/// has turned by 180° from rest: see `largestTurn` below.
///
/// Strain at a node is the rotation of one section relative to the other beyond that at rest: its components along the
/// rest directors and tangent are the two changes of curvature and of twist, times the length. The stiffness is that of
/// two half segments in series, each 2/length times diag(E I₁, E I₂, G J) on its own directors, so that kinks and
/// changes of section bend and twist as they do in a beam. (Bergou's curvature 2 tan(angle/2) agrees to second order
/// for smooth rods, but a right-angled kink would be four times too stiff.) At a frame each half segment acts between
/// its section and the frame: bending and twist pass from each segment to all others through a rigid joint, as in Perez
/// et al. (2015); pairwise couplings of the segments without a joint (Zehnder et al. 2016) need no coordinates more but
/// are as stiff as a joint for two segments only. A closed ring has no first segment.
class RodNetwork {
 public:
  /// `restPositions` begin with 3 coordinates a node. Scalar coordinates are counted from `firstScalar`: twists of all
  /// segments, then frames by ascending node. Throws base::InputError (location empty) for segments, sections or
  /// materials that make no sense, for a director along its segment, and for a framed node without segments.
  RodNetwork(const Vector& restPositions, std::vector<RodSegment> segments, const std::vector<int>& framedNodes,
             int firstScalar);

  const std::vector<RodSegment>& segments() const { return segments_; }
  int scalarCount() const;

  int twistCoordinate(int segment) const { return firstScalar_ + segment; }
  double twistLength(int segment) const;  ///< [m]

  /// Nodes with a frame, and the first of its three coordinates.
  const std::map<int, int>& frameCoordinates() const { return frames_; }
  double frameLength(int node) const;  ///< the largest twist length of the node's segments [m]

  /// Stretch, bending and twist; an energy for each kind of element that there is.
  std::vector<std::shared_ptr<const Energy>> energies() const;

  /// Adds the mass on positions, and the inertia of sections about the rod on twists: density * polarInertia * length,
  /// over twistLength². A quarter of it goes to a frame at either end (about every axis alike).
  void addMass(MassMatrix kind, std::vector<Eigen::Triplet<double>>& entries) const;

 private:
  struct HalfSegment;

  double restLength(int segment) const;
  /// The halves of segments at each node.
  std::map<int, std::vector<HalfSegment>> halves() const;

  Vector restPositions_;
  std::vector<RodSegment> segments_;
  std::map<int, int> frames_;
  int firstScalar_;
};

/// Material frames cannot be told where a segment has turned by 180° from rest; past this angle [rad] results of rods
/// are not to be trusted.
inline constexpr double largestTrustedTurn = 170 * std::numbers::pi / 180;

/// The largest angle by which a segment of any of the model's rods has turned from rest at `positions` (of all
/// coordinates [m]), 0 to π [rad]. None if the model has no rods.
std::optional<double> largestTurn(const Model& model, const Vector& positions);

}  // namespace pliant::mechanics
