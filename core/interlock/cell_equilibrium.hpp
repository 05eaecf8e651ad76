#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/interlock/element_pull.hpp"
#include "core/interlock/linking_number.hpp"

namespace pliant::interlock {

/// What pulls on a cell: the strain moves along `directions` (columns, linearly independent) from where it is, and
///   -load · ε + ½ spring |ε - target|²
/// plus what pulls on elements is minimised under contact (thesis 4.3.1, 4.3.3). With a load alone the cell is deformed
/// until it locks.
struct StrainDrive {
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> directions = Eigen::Matrix3d::Identity();
  Eigen::Vector3d load = Eigen::Vector3d::Zero();
  double spring = 0;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  std::vector<ElementPull> pulls;
  /// The cell is not moved farther than until load · ε has grown by this.
  double farthest = std::numeric_limits<double>::infinity();
};

struct EquilibriumOptions {
  double finalGap = 1e-4;  ///< mean gap of the contacts that hold, relative to the smallest radius
  double firstGap = 0.1;   ///< the same in the first of the problems that lead there
  double reduction = 0.1;  ///< of the gap from each to the next
  double rangeRatio = 10;  ///< range of the barrier over the gap wanted
  /// Newton's decrement over the barrier's weight at which the problems on the way count as solved.
  double looseTolerance = 0.1;
  int maximumIterations = 600;  ///< of Newton's method, in all
  /// Coulomb's coefficient of all contacts; 0: none. See restWithFriction: where a structure comes to rest then depends
  /// on its way there.
  double friction = 0;
};

/// For states on the way to a limit, which need not be exact.
EquilibriumOptions withLooserGaps(EquilibriumOptions options);

/// How a cell came to rest.
enum class RestKind {
  locked,     ///< contacts hold it against the load
  reached,    ///< the target, or the farthest that was asked for
  unlimited,  ///< nothing holds it: a stretch fell below 0.05 or rose above 20, or an element flew away
};

struct CellEquilibrium {
  base::TerminationType termination = base::TerminationType::failed;
  std::string message;  ///< one sentence if not converged
  RestKind kind = RestKind::locked;
  CellState state;
  std::vector<CellContactForce> contacts;  ///< that push, the last of them
  /// Σ force · gap: to first order, how much lower the objective would be without any gaps; in units of `load · ε`.
  double remaining = 0;
  double meanGap = 0;      ///< of contacts, weighted by their forces [m]; 0 if there are none
  double smallestGap = 0;  ///< of all pairs of parts [m], or the barrier's range if that is less
  double weight = 0;       ///< of the last barrier
  int iterations = 0;

  bool converged() const { return termination == base::TerminationType::converged; }
};

/// Elements moved and turned at random by about `amplitude` times `radius`, by `move` (a velocity and a step), less if
/// they would come nearer than half the smallest gap. The same for the same seed.
CellState perturbedState(const CellContact& contact, const CellState& state, double radius, double amplitude,
                         unsigned seed, const std::function<CellState(const Eigen::VectorXd&, double)>& move);

/// Statics of a cell under contact: Newton's method for the energy with a barrier that shrinks until contacts are as
/// near as asked for.
/// - The Hessian's eigenvalues are taken by their absolute values, so that saddles repel.
/// - Elements never pass through one another. For two places to meet in the middle of a step, both sets of which they
///   are points must have been farther apart than their radii s = r_A + r_B before and after, so the two together must
///   have moved by more than 2 s. Steps are shorter than that, and gaps are above 0 at both ends of each. Those of
///   pieces that are thinner than the length steps are measured by, as meshes are, end where safeFraction says.
/// - Linking numbers are compared before and after all the same: a change is a failure.
class CellSolver {
 public:
  /// The cell must have passed checkCell.
  explicit CellSolver(const UnitCell& cell, const EquilibriumOptions& options = {});
  CellSolver(const CellSolver&) = delete;
  CellSolver& operator=(const CellSolver&) = delete;

  const CellContact& contact() const { return contact_; }
  const EquilibriumOptions& options() const { return options_; }
  /// What the cell is linked by at rest.
  const std::vector<Link>& links() const { return links_; }

  /// From a state whose elements do not overlap and are linked as at rest; otherwise the result has failed.
  CellEquilibrium solve(const CellState& start, const StrainDrive& drive,
                        const base::ExecutionContext* context = nullptr) const;

  /// The elements moved apart from each other as far as the strain, which is kept, lets them within a barrier's range
  /// of the smallest radius.
  CellState relaxed(const CellState& state) const;

  /// Elements moved and turned at random by about `amplitude` times the smallest radius, less if they would come nearer
  /// than half the smallest gap: breaks symmetries that would hold a structure on a saddle. The same for the same seed.
  CellState perturbed(const CellState& state, double amplitude, unsigned seed) const;

 private:
  friend class EquilibriumSearch;

  CellContact contact_;
  EquilibriumOptions options_;
  LinkFinder linkFinder_;
  std::vector<Link> links_;
  double radius_;        ///< smallest of all pieces [m]
  double latticeScale_;  ///< [m]
};

}  // namespace pliant::interlock
