#include "core/harmonic/response_sensitivity.hpp"

#include "core/harmonic/jacobian_solver.hpp"
#include "core/harmonic/refined_solve.hpp"

namespace pliant::harmonic {

ResponseSensitivity::ResponseSensitivity(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion)
    : z_(motion.z) {
  const auto& parameters = problem.model().parameters;
  Matrix rightSide(problem.size(), static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t p = 0; p < parameters.size(); ++p)
    rightSide.col(static_cast<Eigen::Index>(p)) = -problem.parameterDerivative(z_, motion.omega, *parameters[p]);
  derivative_ = Matrix::Zero(rightSide.rows(), rightSide.cols());
  if (parameters.empty()) return;

  JacobianSolver solver(problem);
  Vector h;
  solver.linearize(z_, motion.omega, h, nullptr);
  Matrix unknowns;
  if (motion.factorization &&
      solveRefined(solver.jacobian(), *motion.factorization, false, problem.restricted(rightSide), unknowns)) {
    derivative_ = problem.expanded(unknowns);
    return;
  }
  regular_ = solver.factorize();
  derivative_ = regular_ ? solver.solve(rightSide) : Matrix::Zero(rightSide.rows(), rightSide.cols());
}

Vector ResponseSensitivity::predict(const Vector& parameterChange) const { return z_ + derivative_ * parameterChange; }

}  // namespace pliant::harmonic
