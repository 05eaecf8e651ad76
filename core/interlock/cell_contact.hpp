#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "core/interlock/element_parts.hpp"
#include "core/interlock/part_distance.hpp"
#include "core/interlock/unit_cell.hpp"

namespace pliant::interlock {

/// Where the elements of a cell are. `strain` holds the coordinates (mean, deviator, shear) = (m, a, b) of the stretch
///   F = [1 + m + a, b; b, 1 + m - a],
/// which is symmetric: a rotation in the plane is left to the elements. A state with the principal stretches 1 + ε_p
/// in the direction θ and 1 + ε_o across it is m = (ε_p + ε_o)/2, (a, b) = (ε_p - ε_o)/2 (cos 2θ, sin 2θ).
/// Of a finite patch it holds the curvature [1/m] of a paraboloid in the same way, see PatchSolver.
struct CellState {
  Eigen::Matrix3Xd positions;              ///< of the elements' origins [m]
  std::vector<Eigen::Matrix3d> rotations;  ///< of the elements
  Eigen::Vector3d strain = Eigen::Vector3d::Zero();
};

struct ContactTerms;

CellState restState(const UnitCell& cell);
Eigen::Matrix2d stretchOf(const Eigen::Vector3d& strain);
/// stretchOf(strain) = I + Σ strain_k · of these.
const std::array<Eigen::Matrix2d, 3>& stretchBasis();
/// The state moved by `step` times a velocity: six numbers an element (translation [m], rotation vector, from the left)
/// and the three of the strain.
CellState moved(const CellState& state, const Eigen::VectorXd& velocity, double step);

/// Two parts of different elements, or of an element and one of its own images.
struct PartPair {
  int a, b;                  ///< elements, a <= b
  std::array<int, 2> shift;  ///< lattice vectors by which b is moved
  int partA, partB;
};

/// One contact that pushes.
struct CellContactForce {
  PartPair pair;
  double gap;              ///< [m]
  double force;            ///< -dE/dgap [1/m]
  Eigen::Vector3d place;   ///< midway between the surfaces [m]
  Eigen::Vector3d normal;  ///< from B to A
};

/// Contact between the elements of a periodic cell, or of a finite patch, which has no images. Each pair of parts at
/// gap g = distance - radii adds weight · b(g)/range², with b the barrier of mechanics::BarrierFunction; the energy has
/// no unit. Close to contact its force is weight/g.
class CellContact {
 public:
  struct Barrier {
    double weight;
    double range;   ///< [m]
    int split = 1;  ///< each arc counts as so many
    /// Hessians of contacts that push harder are scaled down as if they pushed like this [1/m].
    double largestForce = std::numeric_limits<double>::infinity();
  };

  /// The default cuts a circle into 24 arcs.
  explicit CellContact(const UnitCell& cell, double arcTurn = 0.262);

  const UnitCell& cell() const { return cell_; }
  const ElementParts& partsOf(int element) const { return parts_[cell_.elements[element].shape]; }
  /// Whether some pieces are so thin against the length by which steps are measured, UnitCell::smallestRadius, that
  /// these could pass one through another: then steps are bounded by safeFraction.
  bool hasThinPieces() const;
  /// Coordinates of a velocity, see `moved`.
  int coordinateCount() const { return 6 * static_cast<int>(cell_.elements.size()) + 3; }

  /// Pairs of elements of which balls around them are less than `reach` apart [m], with the shift of the second.
  struct ImagePair {
    int a, b;
    std::array<int, 2> shift;
  };
  std::vector<ImagePair> nearElements(const CellState& state, double reach) const;
  /// All pairs of parts with a gap below `reach` [m], and some others.
  std::vector<PartPair> nearParts(const CellState& state, double reach) const;

  /// Calls `visit` for each contact within range, with its terms: derivatives as far as wanted. Returns the energy of
  /// the pairs; infinite if any of them overlap, or a number is not finite, and then some contacts are not visited.
  using Visitor = std::function<void(const PartPair&, const ContactTerms&)>;
  double visitContacts(const CellState& state, const std::vector<PartPair>& pairs, const Barrier& barrier,
                       bool wantGradient, bool wantHessian, const Visitor& visit) const;

  /// Energy of the pairs; infinite if any of them overlap, or a number is not finite. `gradient` and `hessian` get one
  /// entry a coordinate, `smallestGap` the least of all gaps or the range, `forces` all contacts within range; null
  /// where not wanted.
  double energy(const CellState& state, const std::vector<PartPair>& pairs, const Barrier& barrier,
                Eigen::VectorXd* gradient = nullptr, Eigen::MatrixXd* hessian = nullptr, double* smallestGap = nullptr,
                std::vector<CellContactForce>* forces = nullptr) const;

  /// Of all pairs of parts [m], if below `reach`, else `reach`. Negative if elements overlap. `where` gets the pair, if
  /// there is one.
  double smallestGap(const CellState& state, double reach, PartPair* where = nullptr) const;

  /// x_a - x_b - F L shift [m].
  Eigen::Vector3d offsetOf(const CellState& state, int a, int b, const std::array<int, 2>& shift) const;

 private:
  struct Pose;  ///< all parts turned
  std::vector<Pose> posesOf(const CellState& state) const;
  PlacedPart placed(const std::vector<Pose>& poses, int element, int part) const;
  UnitCell cell_;
  std::vector<ElementParts> parts_;  ///< by shape
};

}  // namespace pliant::interlock
