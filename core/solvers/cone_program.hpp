#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"

namespace pliant::solvers {

/// A bound on a linear map of three nodes' positions: F = Σ x_k w_kᵀ (3 x 2) with FᵀF ⪯ I, so that no direction is
/// stretched beyond 1 in the metric that the weights contain.
struct MatrixCone {
  std::array<int, 3> nodes;
  std::array<Eigen::Vector2d, 3> weights;  ///< w_k [1/m]
};

/// A bound on one vector: ‖Σ w_k x_k‖ <= 1.
struct VectorCone {
  std::array<int, 3> nodes;
  std::array<double, 3> weights;  ///< w_k [1/m]
};

/// min ½ Σ m_i ‖x_i - x̂_i‖² over the positions x of the nodes that are not fixed, subject to cones.
struct ConeConstraints {
  int nodeCount = 0;
  std::vector<MatrixCone> matrixCones;
  std::vector<VectorCone> vectorCones;
  Eigen::VectorXd masses;   ///< weights of the norm, above 0, one a node [kg]
  std::vector<char> fixed;  ///< per node
};

struct ConeProgramOptions {
  double relativeGap = 1e-8;  ///< of the duality gap, relative to the objective
  /// The duality gap at which a problem counts as solved however small its objective is, relative to the total mass
  /// times the squared size of the model.
  double absoluteGap = 1e-16;
  double violation = 1e-9;  ///< of a limit: largest stretch - 1
  int maximumIterations = 100;
  bool warmStart = true;  ///< from the multipliers of the last solution
};

/// The optimum with what proves it.
struct ConeSolution {
  Eigen::Matrix3Xd positions;  ///< x; fixed nodes as the candidate has them [m]
  /// Multipliers per matrix cone, symmetric 2 x 2 as (00, 11, 01), and per vector cone [J s²]: the gradient of the
  /// objective is balanced by -Σ (F Λ) wᵀ and -Σ λ f w.
  Eigen::Matrix3Xd matrixMultipliers;
  Eigen::VectorXd vectorMultipliers;
  double objective = 0;        ///< P = ½ ‖x - x̂‖²_M [kg m²]
  double bound = 0;            ///< D: no x that keeps the limits is nearer; ‖x - x*‖_M <= sqrt(2 (P - D))
  double violation = 0;        ///< largest stretch - 1 over all cones, 0 if none is above
  double dualResidual = 0;     ///< ‖M(x - x̂) + Bᵀ(FΛ)‖ / ‖M(x - x̂)‖, in the maximum norm
  double complementarity = 0;  ///< Σ ⟨Λ, S⟩ / P
  base::SolverReport report;   ///< residual: relative gap; correction: violation
  /// If infeasible: the cones (matrix cones first, then vector cones) and fixed nodes that contradict each other,
  /// those with the largest share of the proof first.
  std::vector<int> conflictingCones;
  std::vector<int> conflictingNodes;

  double gap() const { return objective - bound; }
  double relativeGap() const { return objective > 0 ? gap() / objective : 0; }
};

/// Projects positions onto stretch limits: the global optimum of a convex program (thesis 3.2), by a primal-dual
/// interior-point method with one 2 x 2 multiplier a matrix cone, whose Newton system is condensed onto the positions.
/// The symbolic factorisation and the last multipliers are kept between solves.
class ConeProgram {
 public:
  /// Throws base::InputError (location empty) for a mass that is not above 0 or a node out of range.
  explicit ConeProgram(ConeConstraints constraints);
  ~ConeProgram();
  ConeProgram(ConeProgram&&) noexcept;

  const ConeConstraints& constraints() const;

  /// `candidate`: x̂, 3 x nodes, finite; its fixed nodes are where they are to be [m]. `start`: where to look first, as
  /// a rule the projection before; it need not keep the limits. Throws base::InputError if a number is not finite.
  ConeSolution solve(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                     const ConeProgramOptions& options, base::ExecutionContext& context);

  /// Forgets the multipliers of the last solution.
  void reset();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pliant::solvers
