#pragma once

#include <Eigen/Core>
#include <vector>

namespace pliant::interlock {

/// A smooth closed curve as a finite Fourier series, t in [0, 2π):
///   c(t) = c_0 + Σ a_k cos kt + b_k sin kt.
/// Circles, ellipses and torus curves are such series exactly, so one piece of code serves them all without any error
/// of approximation.
class ClosedCurve {
 public:
  /// One term of the series [m].
  struct Harmonic {
    int order;  ///< k, above 0
    Eigen::Vector3d cosine, sine;
  };
  /// A point of the curve [m] with its derivatives by t [m].
  struct Point {
    Eigen::Vector3d place, tangent, second;
  };

  /// Harmonics of one order are added up; a negative order is that of its absolute value with the sine turned round.
  ClosedCurve(const Eigen::Vector3d& centre, const std::vector<Harmonic>& harmonics);

  /// Counterclockwise about `normal` (any length but 0). Radius in [m].
  static ClosedCurve circle(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double radius);
  /// centre + first cos t + second sin t.
  static ClosedCurve ellipse(const Eigen::Vector3d& centre, const Eigen::Vector3d& first,
                             const Eigen::Vector3d& second);
  /// ((A + B cos qt) cos pt, (A + B cos qt) sin pt, C sin qt): a torus knot where p and q have no divisor in common,
  /// a coil if p = 1. Lengths in [m].
  static ClosedCurve torusCurve(int p, int q, double a, double b, double c);

  const Eigen::Vector3d& centre() const { return centre_; }
  const std::vector<Harmonic>& harmonics() const { return harmonics_; }

  Point at(double t) const;
  Eigen::Vector3d placeAt(double t) const;
  /// Turned about the origin by the rotation.
  ClosedCurve rotated(const Eigen::Matrix3d& rotation) const;
  /// A bound of |c''| [m] for all t.
  double secondDerivativeBound() const;
  /// Parameters 0 = t_0 < t_1 < ... < t_n = 2π, shifted by a constant, between which the tangent turns by at most
  /// `turn` [rad]. The shift keeps the points away from the curve's axes of symmetry, where contacts of regular
  /// structures are.
  std::vector<double> breakpoints(double turn) const;

 private:
  Eigen::Vector3d centre_;
  std::vector<Harmonic> harmonics_;  ///< sorted by order
};

}  // namespace pliant::interlock
