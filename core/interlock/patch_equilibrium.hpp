#pragma once

#include "core/interlock/cell_equilibrium.hpp"
#include "core/interlock/patch.hpp"

namespace pliant::interlock {

/// A force [N] on a point of one element.
struct PointLoad {
  int element = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N]
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();    ///< from the element's origin, in its coordinates [m]
};

/// What acts on a patch whose elements are otherwise free in space; adds -Σ force · place to the objective [J].
struct PatchLoads {
  std::vector<PointLoad> forces;
  std::vector<int> clamped;  ///< elements that do not move
};

/// Where a paraboloid is steeper below an element its patch stands upright, with less than 23 degrees between opposite
/// arms: it has folded, and nothing that holds it later is a limit of bending.
constexpr double steepestSlope = 5;

/// Weights of all elements, at their centres of mass. Density in [kg/m³], gravity in [m/s²].
std::vector<PointLoad> weightsOf(const UnitCell& patch, double density, const Eigen::Vector3d& gravity);

/// Statics of a finite patch of rigid elements in space under contact, by the descent that cells have as well: the same
/// contact energy and barriers, steps that pass nothing by, linking numbers compared. Newton's systems are sparse, with
/// exact Hessians: a shift that makes them positive definite and keeps steps short is found in each (Moré & Sorensen
/// 1983), so that saddles repel.
class PatchSolver {
 public:
  /// Of a patch from cutPatch, or any cell without lattice that has passed checkCell.
  explicit PatchSolver(const UnitCell& patch, const EquilibriumOptions& options = {});
  PatchSolver(const PatchSolver&) = delete;
  PatchSolver& operator=(const PatchSolver&) = delete;

  const CellContact& contact() const { return contact_; }
  const UnitCell& patch() const { return contact_.cell(); }
  const EquilibriumOptions& options() const { return options_; }
  const std::vector<Link>& links() const { return links_; }
  /// Smallest of all pieces [m].
  double radius() const { return radius_; }
  /// Distance of the farthest origin from the middle at rest [m].
  double extent() const { return extent_; }

  /// Rest under loads, with EquilibriumOptions::friction. Throws base::InputError (location empty) if elements are
  /// named that are not there.
  CellEquilibrium solve(const CellState& start, const PatchLoads& loads,
                        const base::ExecutionContext* context = nullptr) const;

  /// Origins lie on the paraboloid whose curvatures are the state's `strain`, at the heights above it that they have at
  /// rest, and slide on it freely, as elements turn freely (thesis 4.3.4, equation 4.3.4); but so that the mean origin
  /// stays at the apex and the patch does not turn about its axis as a whole, Σ X_i × x_i = 0 for origins X_i at rest.
  /// The drive moves the curvature [1/m], as it does the strain of a cell; it pulls on no elements. Without friction.
  CellEquilibrium bend(const CellState& start, const StrainDrive& drive,
                       const base::ExecutionContext* context = nullptr) const;

  /// The same by increments, so that elements slide out of each other's way before they jam: first and after each the
  /// barrier alone centres the elements in the room they have; the curvature moves as far at a time as would lift the
  /// outermost element by `increment` smallest radii [0: at once, without centring]. Where contact holds the drive even
  /// after elements have been centred again it is followed up to the final gap.
  CellEquilibrium bendInSteps(const CellState& start, const StrainDrive& drive, double increment,
                              const base::ExecutionContext* context = nullptr) const;

  /// On its paraboloid, see CellSolver::relaxed.
  CellState relaxed(const CellState& state) const;
  /// On its paraboloid, see CellSolver::perturbed.
  CellState perturbed(const CellState& state, double amplitude, unsigned seed) const;

 private:
  friend class PatchSearch;
  CellEquilibrium checked(const CellState& start, const std::function<CellEquilibrium()>& run) const;

  CellContact contact_;
  EquilibriumOptions options_;
  LinkFinder linkFinder_;
  std::vector<Link> links_;
  double radius_, extent_;
};

}  // namespace pliant::interlock
