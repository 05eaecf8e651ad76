#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"

namespace pliant::solvers {

/// Bounds on the metric C = FᵀF (2 x 2) of a linear map F (3 x 2): any number of both kinds.
struct MetricBounds {
  std::vector<Eigen::Matrix2d> ellipses;  ///< C ⪯ S, S symmetric positive definite
  /// dᵀCd <= b² for a unit vector d, as d / b.
  std::vector<Eigen::Vector2d> directions;
};

/// Three nodes whose positions give F = Σ x_k w_kᵀ.
struct ConeElement {
  std::array<int, 3> nodes;
  std::array<Eigen::Vector2d, 3> weights;  ///< w_k [1/m]
  int bounds = 0;                          ///< index into ConeConstraints::bounds
};

/// min ½ Σ m_i ‖x_i - x̂_i‖² over the positions x of the nodes that are not fixed, subject to the bounds.
struct ConeConstraints {
  int nodeCount = 0;
  std::vector<ConeElement> elements;
  std::vector<MetricBounds> bounds;
  Eigen::VectorXd masses;   ///< weights of the norm, above 0, one a node [kg]
  std::vector<char> fixed;  ///< per node
};

/// Where a stiffness K couples coordinates 3 node + axis: the lower triangle, rows[s] >= columns[s], in whole 3 x 3
/// blocks.
struct ConeStiffness {
  std::vector<int> rows, columns;
};

struct ConeProgramOptions {
  double relativeGap = 1e-8;  ///< the duality gap relative to the objective, and the dual residual
  /// The duality gap at which a problem counts as solved however small its objective is, relative to the total mass
  /// times the squared size of the model.
  double absoluteGap = 1e-16;
  double violation = 1e-9;  ///< of a limit: largest stretch - 1
  int maximumIterations = 100;
  bool warmStart = true;       ///< from the multipliers of the last solution
  bool explainFailure = true;  ///< where it stalls, to find out whether the limits can be kept at all
};

/// The optimum with what proves it.
struct ConeSolution {
  Eigen::Matrix3Xd positions;  ///< x; fixed nodes as the candidate has them [m]
  /// Per element the symmetric 2 x 2 multiplier Λ of C as (00, 11, 01), the sum over its bounds; 3 x elements
  /// [kg m²]. At the optimum M(x - x̂) = -Σ (F Λ) w.
  Eigen::Matrix3Xd multipliers;
  /// Of each bound, in the order of the elements: of ellipses T⁻¹ΛT⁻¹ with T = S^{-½}, as (00, 11, 01), and of
  /// directions. Empty if the method has none.
  Eigen::Matrix3Xd ellipseMultipliers;
  Eigen::VectorXd directionMultipliers;
  double objective = 0;        ///< P = ½ ‖x - x̂‖²_M [kg m²]
  double bound = 0;            ///< D: no x that keeps the limits is nearer; ‖x - x*‖_M <= sqrt(2 (P - D))
  double violation = 0;        ///< largest stretch - 1 over all bounds, 0 if none is above
  double dualResidual = 0;     ///< ‖M(x - x̂) + Bᵀ(FΛ)‖ / ‖M(x - x̂)‖, in the maximum norm
  double complementarity = 0;  ///< Σ ⟨Λ, S⟩ / P
  base::SolverReport report;   ///< residual: relative gap; correction: violation
  /// If infeasible: the elements and fixed nodes that contradict each other, those with the largest share of the proof
  /// first. The positions then keep bounds that are looser by the factor that the message names.
  std::vector<int> conflictingElements;
  std::vector<int> conflictingNodes;

  double gap() const { return objective - bound; }
  double relativeGap() const { return objective > 0 ? gap() / objective : 0; }
};

/// Projects positions onto stretch limits: the global optimum of a convex program (thesis 3.2), by a primal-dual
/// interior-point method with one 2 x 2 multiplier an ellipse, whose Newton system is condensed onto the positions.
/// The symbolic factorisation and the multipliers of the last solutions are kept between solves.
class ConeProgram {
 public:
  /// Throws base::InputError (location empty) for a mass that is not above 0, a node out of range, or a bound that is
  /// not positive definite.
  explicit ConeProgram(ConeConstraints constraints, ConeStiffness stiffness = {});
  ~ConeProgram();
  ConeProgram(ConeProgram&&) noexcept;

  /// From now on the objective is ½ (x - x̂)ᵀ H (x - x̂) with H = (1 + inertia) M + K, and so are all norms of the
  /// solution; `entries` of K in the order that the constructor was given [kg]. False if H is not positive definite.
  bool setStiffness(const Eigen::VectorXd& entries, double inertia);

  const ConeConstraints& constraints() const;

  /// `candidate`: x̂, 3 x nodes, finite; its fixed nodes are where they are to be [m]. `start`: where to look first, as
  /// a rule the projection before; it need not keep the limits. Throws base::InputError if a number is not finite.
  ConeSolution solve(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                     const ConeProgramOptions& options, base::ExecutionContext& context);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pliant::solvers
