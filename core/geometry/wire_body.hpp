#pragma once

#include <optional>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/geometry/implicit_surface.hpp"

namespace pliant::geometry {

/// All places within `rounding` of a straight bar with a rectangular section: of a round wire, a line, whose section
/// has no size. Lengths in [m].
struct WirePiece {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  double rounding = 0;  ///< above 0
  double halfWidth = 0, halfHeight = 0;
  Eigen::Vector3d widthDirection = Eigen::Vector3d::Zero();  ///< unit, across the bar; of no account if it is round
  int strand = 0;  ///< pieces of one strand follow one another; a fillet fills the corners between different strands
};

/// Sets the strands of pieces that meet: at each place where some end, those that go on most nearly straight, by less
/// than 60°, are of one strand.
void findStrands(std::vector<WirePiece>& pieces);

/// A part of a spherical shell that holds a ball, with a round rim. [m]
struct BallSocket {
  Eigen::Vector3d centre;
  double radius = 0;                                   ///< of its inside
  double wall = 0;                                     ///< thickness
  Eigen::Vector3d opening = Eigen::Vector3d::UnitZ();  ///< unit direction
};

/// The rim of a socket stands at this angle from the middle of its opening [rad]: 20° beyond the ball's middle.
inline constexpr double socketOpening = 70 * 3.14159265358979323846 / 180;

/// The direction that is farthest from where pieces of wire pass a ball's surface; of several, the first found. Unit
/// vector.
Eigen::Vector3d openDirection(const std::vector<WirePiece>& pieces, const Eigen::Vector3d& centre, double radius);

/// The closed surface of wires and sockets together, less the insides of the sockets (meshBody). Where strands meet
/// each other or a socket, distances a and b are blended to min(a, b) - max(k - |a - b|, 0)²/(4k) with k the smallest
/// rounding (Quilez, "Smooth minimum"), which rounds the corner and nowhere adds more than k/4 for each strand that
/// meets another. Where triangles cross between walls at acute angles the mesh is smoothed, beyond the tolerance if
/// need be, or made of smaller cells; checkSolid finds those that still cross. None once cancelled. Throws
/// base::InputError (location empty) if a size is not above 0, there is no piece, or the mesh would be too fine.
std::optional<BodyMesh> meshWires(const std::vector<WirePiece>& pieces, const std::vector<BallSocket>& sockets,
                                  double tolerance, const base::ExecutionContext& context);

}  // namespace pliant::geometry
