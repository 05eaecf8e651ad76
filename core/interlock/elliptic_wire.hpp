#pragma once

#include "core/interlock/unit_cell.hpp"

namespace pliant::interlock {

/// A wire may have an elliptic cross-section (thesis Fig. 4.2): half of it is `radius` wide in the ring's plane and
/// `aspect` · `radius` along the ring's axis. An ellipse is the union of the discs along its longer axis that touch it
/// from inside, so a ring with such a wire is a bundle of circles with radii of their own: those of an odd number of
/// discs at equal steps, those at the ends touching the ellipse where it bends most. The bundle is exact
/// where these touch, and nowhere outside the ellipse.

/// Circles and their radii; a single one if aspect is 1. As many as it takes to be nowhere farther inside the ellipse
/// than `largestSectionError` times its smaller half axis. Throws base::InputError (location empty) if the aspect is
/// not between 1/3 and 3.
std::vector<DilatedPiece> ellipticRing(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double ring,
                                       double radius, double aspect);
inline constexpr double largestSectionError = 0.02;

/// One disc of an ellipse with half axes a (longer) and b (shorter).
struct SectionDisc {
  double offset;  ///< of its centre along the longer axis [m]
  double radius;  ///< [m]
};
/// `count` discs, odd; and how far their union is inside the ellipse at most [m].
std::vector<SectionDisc> sectionDiscs(double a, double b, int count);
double sectionError(double a, double b, int count);

/// The same links, for elements whose pieces that are linked have each become a bundle of `count`, one after the other.
std::vector<Link> bundledLinks(const std::vector<Link>& links, int count);

}  // namespace pliant::interlock
