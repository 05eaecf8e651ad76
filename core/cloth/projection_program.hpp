#pragma once

#include <IpTNLP.hpp>

#include "core/base/execution_context.hpp"
#include "core/solvers/cone_program.hpp"

namespace pliant::cloth {

/// The projection onto stretch limits as Ipopt wants a problem. The constraint functions of one element, one after the
/// other: per ellipse tr C' <= 2 and det(I - C') >= 0 with C' = T FᵀF T, T = S^{-½}; per direction |Fv|² <= 1. The
/// variables are the coordinates of the nodes that are not fixed. What is given is referred to, not copied.
class ProjectionProgram final : public Ipopt::TNLP {
 public:
  ProjectionProgram(const solvers::ConeConstraints& constraints, const Eigen::Matrix3Xd& candidate,
                    const Eigen::Matrix3Xd& start, base::ExecutionContext& context);

  base::TerminationType termination = base::TerminationType::failed;
  std::string message = "Ipopt did not begin.";
  std::vector<base::IterationRecord> iterations;
  const Eigen::Matrix3Xd& positions() const { return positions_; }
  /// Of the bounds, as in ConeSolution.
  void multipliers(solvers::ConeSolution& solution) const;

  bool get_nlp_info(Ipopt::Index& variables, Ipopt::Index& rows, Ipopt::Index& jacobian, Ipopt::Index& hessian,
                    IndexStyleEnum& style) override;
  bool get_bounds_info(Ipopt::Index variables, double* low, double* high, Ipopt::Index rows, double* rowLow,
                       double* rowHigh) override;
  bool get_starting_point(Ipopt::Index variables, bool wantsX, double* x, bool wantsZ, double* zLow, double* zHigh,
                          Ipopt::Index rows, bool wantsLambda, double* lambda) override;
  bool eval_f(Ipopt::Index variables, const double* x, bool isNew, double& value) override;
  bool eval_grad_f(Ipopt::Index variables, const double* x, bool isNew, double* gradient) override;
  bool eval_g(Ipopt::Index variables, const double* x, bool isNew, Ipopt::Index rowCount, double* g) override;
  bool eval_jac_g(Ipopt::Index variables, const double* x, bool isNew, Ipopt::Index rowCount, Ipopt::Index entries,
                  Ipopt::Index* rows, Ipopt::Index* columns, double* values) override;
  bool eval_h(Ipopt::Index variables, const double* x, bool isNew, double factor, Ipopt::Index rowCount,
              const double* lambda, bool isNewLambda, Ipopt::Index entries, Ipopt::Index* rows, Ipopt::Index* columns,
              double* values) override;
  bool intermediate_callback(Ipopt::AlgorithmMode mode, Ipopt::Index iteration, double objective, double primal,
                             double dual, double barrier, double directionNorm, double regularization, double dualStep,
                             double step, Ipopt::Index trials, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities* quantities) override;
  void finalize_solution(Ipopt::SolverReturn status, Ipopt::Index variables, const double* x, const double* zLow,
                         const double* zHigh, Ipopt::Index rows, const double* g, const double* lambda,
                         double objective, const Ipopt::IpoptData* data,
                         Ipopt::IpoptCalculatedQuantities* quantities) override;

 private:
  using Map = Eigen::Matrix<double, 3, 2>;
  using Square = Eigen::Matrix<double, 6, 6>;

  int rowsOf(const solvers::ConeElement& element) const;
  void take(const double* x);
  Map mapOf(const solvers::ConeElement& element) const;
  static Eigen::Matrix2d adjugateOfRest(const Map& scaled);
  /// Second derivatives of Σ λ g by the columns of F.
  Square hessianByMap(const solvers::ConeElement& element, const double*& lambda) const;

  const solvers::ConeConstraints& constraints_;
  const Eigen::Matrix3Xd& candidate_;
  Eigen::Matrix3Xd positions_;
  base::ExecutionContext& context_;
  std::vector<int> variable_;  ///< per node: its first variable, -1: fixed
  int variableCount_ = 0;
  std::vector<std::vector<Eigen::Matrix2d>> scalings_;
  double scale_ = 1;
  std::vector<double> lambda_;
};

}  // namespace pliant::cloth
