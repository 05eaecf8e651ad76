#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/mechanics/contact_element.hpp"
#include "core/mechanics/contact_geometry.hpp"

namespace pliant::mechanics {

struct ContactOptions {
  double range = 0;       ///< gap below which surfaces repel each other [m], above 0
  double stiffness = 0;   ///< κ [J/m²], above 0: a pair of primitives at gap g has the energy κ b(g), b in m²
  double separation = 0;  ///< distance beyond their radii that surfaces keep at least [m]
};

/// A block of the Hessian; those of one place add up.
struct ContactBlock {
  int row, column;        ///< nodes, row >= column
  Eigen::Matrix3d entry;  ///< [N/m]
};

/// One pair that is active, for display and checks.
struct Contact {
  ContactPair pair;
  double gap;             ///< [m]
  Eigen::Vector3d force;  ///< that the second primitive exerts on the first [N]
  Eigen::Vector3d place;  ///< midway between the closest points [m]
};

/// Contact without any intersection (Li et al. 2020, "Incremental potential contact"): pairs of primitives whose gap
///   g = distance - radii - separation
/// is below the range have an energy that grows without bounds as g goes to 0 (BarrierFunction), and steps are cut so
/// that no pair gets that far. Each pair counts once, whatever its area: the stiffness belongs to a mesh size.
/// Positions are 3 x nodeCount() [m]. Results are the same for any number of threads.
class ContactBarrier {
 public:
  /// Edges have their lengths at rest in `restPositions` (for the mollifier alone; nothing is checked there). Throws
  /// base::InputError (location empty) as checkContactGeometry, if options are not as said there, or if the rest
  /// positions are not finite or not one a node.
  ContactBarrier(ContactGeometry geometry, Eigen::Matrix3Xd restPositions, const ContactOptions& options);

  const ContactPrimitives& primitives() const { return primitives_; }
  const ContactOptions& options() const { return options_; }

  /// Where to start from must be free: throws base::InputError (location empty) with a sentence that names the nodes if
  /// an edge crosses a triangle, or the gap of a pair is not above 0. A surface wholly inside another is not noticed.
  void requireFree(const Eigen::Matrix3Xd& x) const;

  /// Finds the active pairs at x, for all that follows. Cheap where x is near that of the update before.
  void update(const Eigen::Matrix3Xd& x);
  /// [J]; infinite if a gap is not above 0, which no step below largestStep leads to, or a coordinate not finite.
  double value() const;
  /// Adds to one column a deformable node [N]; other columns are left as they are. Pairs without a gap are left out.
  void addGradient(Eigen::Matrix3Xd& gradient) const;
  /// Appends the blocks of all pairs between deformable nodes, of each pair's Hessian with its negative eigenvalues
  /// taken 1 - convexity times (see ContactElement).
  void addHessian(std::vector<ContactBlock>& blocks, double convexity = 1) const;
  /// Each two deformable nodes that a pair couples whose gap is below the range plus `margin` [m] (at most the range),
  /// in no order and more than once: where blocks of the Hessian are, and may be before anything has moved far.
  std::vector<std::array<int, 2>> coupledNodes(double margin) const;
  /// All active pairs, sorted.
  std::vector<Contact> contacts() const;

  /// A fraction in (0, 1] of the step from x to x + dx (bodies included) such that no pair's gap gets to 0 on the way.
  /// If it is not 1, the gap of the pair that limits it shrinks to a tenth, and to a tenth of the range. 0 if a gap is
  /// not above 0 at x, or if a coordinate is not finite. Cheap while all stays within the range of where the last
  /// update was.
  double largestStep(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& dx) const;

  /// The smallest gap of all pairs [m], negative if they are nearer than they may be (not below minus the radii and the
  /// separation). Infinite if there are no pairs.
  double smallestGap(const Eigen::Matrix3Xd& x) const;

 private:
  geometry::Corners cornersOf(const ContactPair& pair, const Eigen::Matrix3Xd& x) const;
  double gapOf(const ContactPair& pair, const geometry::ClosestPoints& closest) const;
  void findCandidates(const Eigen::Matrix3Xd& x);
  /// By how much the gap of a pair can shrink at most if its nodes move as far as `distances` say [m].
  static double reachOf(const ContactPair& pair, const Eigen::VectorXd& distances);

  struct ActivePair {
    ContactPair pair;
    ContactElement element;
  };

  ContactPrimitives primitives_;
  Eigen::Matrix3Xd restPositions_;
  ContactOptions options_;
  struct Candidate {
    ContactPair pair;
    double gapWhereFound;  ///< at candidatesAt_ [m]
    double gap;            ///< not above that at updatedAt_ [m]
  };

  std::vector<Candidate> candidates_;
  Eigen::Matrix3Xd candidatesAt_;  ///< positions for which candidates_ were found
  Eigen::Matrix3Xd updatedAt_;     ///< those of the last update
  std::vector<ActivePair> active_;
  bool finite_ = true;  ///< the positions of the last update
};

}  // namespace pliant::mechanics
