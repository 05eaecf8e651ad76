#pragma once

#include <Eigen/Core>

namespace pliant::geometry {

/// Which two simplices a distance is between. Their corners stand in this order in the columns of `Corners`.
enum class SimplexPair {
  pointPoint,     ///< p, q
  pointEdge,      ///< p; a, b
  pointTriangle,  ///< p; a, b, c
  edgeEdge        ///< a, b; c, d
};

/// Corners of both simplices [m]; columns beyond cornerCount are ignored.
using Corners = Eigen::Matrix<double, 3, 4>;
/// Coordinates of the four corners one after the other.
using CornerVector = Eigen::Matrix<double, 12, 1>;
using CornerMatrix = Eigen::Matrix<double, 12, 12>;

constexpr int cornerCount(SimplexPair pair) {
  return pair == SimplexPair::pointPoint ? 2 : pair == SimplexPair::pointEdge ? 3 : 4;
}
/// How many corners belong to the first simplex.
constexpr int firstCornerCount(SimplexPair pair) { return pair == SimplexPair::edgeEdge ? 2 : 1; }

/// The closest points of two simplices. Their difference is r = x_A - x_B = corners * weights: the weights of A's
/// corners are those of its closest point and sum up to 1, those of B's corners to -1. Corners with weight 0 have no
/// part in the distance, so the weights that are not 0 tell the region (7 of point and triangle, 9 of two edges).
struct ClosestPoints {
  double squaredDistance = 0;  ///< |r|² [m²]
  /// How many parameters u are free in the region, along which the points can slide: 0 between two corners, 1 between
  /// a corner and the inside of an edge, 2 otherwise.
  int parameterCount = 0;
  Eigen::Vector4d weights = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 4, 2> slopes = Eigen::Matrix<double, 4, 2>::Zero();  ///< d weights / du, constant in a region
};

/// Works for degenerate simplices (edges without length, triangles without area) as well. Where several pairs of points
/// are closest, as between parallel edges, it returns one of them.
/// The distance is good to the rounding of the coordinates' differences; the weights between edges at an angle θ to a
/// multiple of 10⁻¹⁶/θ² times the distance over the length.
ClosestPoints closestPoints(SimplexPair pair, const Corners& corners);

/// The unit vector n = r / |r| from B's closest point to A's. Where the points are free to slide it is perpendicular to
/// that up to rounding, however near they are; their difference alone would carry the rounding of the coordinates over
/// the distance. Finite but arbitrary at distance 0 between points.
Eigen::Vector3d directionBetween(const Corners& corners, const ClosestPoints& closest);

/// First and second derivatives of the squared distance D by the corners [m, 1], within the region of `closest`: with
/// f(x, u) = |r|², D = min_u f, ∇D = f_x and ∇²D = f_xx - f_xu f_uu⁻¹ f_ux. The gradient is continuous across regions,
/// except where edges are parallel; the Hessian is not. Outputs that are null are not computed.
void squaredDistanceDerivatives(const Corners& corners, const ClosestPoints& closest, CornerVector* gradient,
                                CornerMatrix* hessian);

/// The scale ε [m⁴] of the mollifier of two edges, from their corners at rest: 10⁻³ |a|² |b|² with the edges a and b
/// (Li et al. 2020, "Incremental potential contact", section 5.4).
double edgeMollifierScale(const Corners& rest);

/// m = (2 - c/ε) c/ε with c = |a × b|² where c < ε, 1 elsewhere, and its derivatives by the corners [1/m, 1/m²]: a
/// factor that takes the kink out of the distance of nearly parallel edges, by letting it fade. Same source. Outputs
/// that are null are not computed.
double edgeMollifier(const Corners& corners, double scale, CornerVector* gradient, CornerMatrix* hessian);

}  // namespace pliant::geometry
