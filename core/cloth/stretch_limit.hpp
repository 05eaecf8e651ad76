#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

namespace pliant::cloth {

/// How far the material may stretch in one direction of the rest shape.
struct DirectionLimit {
  double angle = 0;  ///< α [rad], from the material's first direction towards its second; α and α + π are the same
  double stretch = 1;  ///< b(α): the largest length over rest length
};

/// The same in every direction.
struct IsotropicLimit {
  double stretch = 1;
};

/// b(α)² = b₁² cos²(α - α₀) + b₂² sin²(α - α₀): the curve that a homogeneous stretch with these principal values has.
struct OrthotropicLimit {
  double first = 1;   ///< b₁
  double second = 1;  ///< b₂
  double angle = 0;   ///< α₀ [rad]
};

/// A curve through points, with period π: cubic pieces with slopes that make no new extrema (Fritsch & Butland 1984).
class LimitCurve {
 public:
  /// In any order. Throws base::InputError (location empty) if there is none, a number is not finite, a stretch is not
  /// above 0, or two angles are the same up to multiples of π.
  explicit LimitCurve(std::vector<DirectionLimit> points);

  /// b(α).
  double operator()(double angle) const;
  /// db/dα, which is continuous.
  double slope(double angle) const;
  /// d²b/dα², which jumps at the points; there it is that of the piece that begins.
  double curvature(double angle) const;
  /// With angles in [0, π), ascending.
  const std::vector<DirectionLimit>& points() const { return points_; }

 private:
  struct Piece {
    double begin, end;            ///< b at its ends
    double slopeBegin, slopeEnd;  ///< db/dα there
    double width;                 ///< [rad]
    double place;                 ///< of the direction asked for, from 0 to 1
  };
  Piece pieceAt(double angle) const;

  std::vector<DirectionLimit> points_;
  std::vector<double> slopes_;  ///< db/dα at each point
};

using StretchLimit = std::variant<IsotropicLimit, OrthotropicLimit, LimitCurve>;

/// b(α).
double stretchAt(const StretchLimit& limit, double angle);

/// The smallest b over all directions: below 1 the rest shape itself breaks the limit.
double smallestStretch(const StretchLimit& limit);

/// A limit as convex constraints on C = FᵀF (2 x 2) of a triangle with deformation gradient F (3 x 2).
struct LimitConstraints {
  std::vector<Eigen::Matrix2d> ellipses;   ///< C ⪯ S: no direction d stretches beyond sqrt(dᵀSd)
  std::vector<DirectionLimit> directions;  ///< dᵀCd <= b²: this direction alone
  /// A bound on what they let through beyond the limit, in any direction: stretch / b(α) - 1. 0 if they are exact.
  double overshoot = 0;
};

/// One ellipse, exactly. Throws std::bad_variant_access for a curve.
LimitConstraints exactConstraints(const StretchLimit& limit);

/// `count` directions, equally spaced from the material's first (thesis 3.1). The overshoot is that of the worst C they
/// allow: 1 / cos(π / 2m) - 1 for an isotropic limit and m directions. Throws base::InputError unless 2 <= count <= 90.
LimitConstraints directionConstraints(const StretchLimit& limit, int count);

/// `count` ellipses whose intersection is the limit: as functions of θ = 2α all dᵀCd are sinusoids, and C ⪯ S is one
/// sinusoid below another. Each of ours touches b² at one of equally spaced directions and is the flattest that stays
/// above b² everywhere, so that the limit is never undercut; the overshoot bound is that of their lower envelope.
/// Throws base::InputError unless 1 <= count <= 90.
LimitConstraints ellipseConstraints(const StretchLimit& limit, int count);

/// Exact where that is possible; else `count` ellipses or directions, whichever lets less through.
LimitConstraints limitConstraints(const StretchLimit& limit, int count);

}  // namespace pliant::cloth
