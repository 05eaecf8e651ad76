#include "core/harmonic/design_gradient.hpp"

#include <numbers>

#include "core/harmonic/jacobian_solver.hpp"
#include "core/harmonic/refined_solve.hpp"

namespace pliant::harmonic {

namespace {

/// λ, or an empty vector if ∂h/∂z is singular.
Vector adjointOf(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion, const Vector& byMotion) {
  JacobianSolver solver(problem);
  Vector h;
  solver.linearize(motion.z, motion.omega, h, nullptr);
  const Matrix right = problem.restricted(byMotion);
  Matrix unknowns;
  ++problem.cost().solves;
  if (motion.factorization && solveRefined(solver.jacobian(), *motion.factorization, true, right, unknowns))
    return problem.expanded(unknowns);
  if (!solver.factorize()) return {};
  return problem.expanded(solver.factorization()->solveTransposed(right));
}

/// What an objective gains because the coordinates that are not free move with p.
double prescribedWork(const HarmonicBalanceProblem& problem, const Matrix& byCoefficients,
                      const mechanics::DesignParameter& parameter) {
  const math::HarmonicBasis& basis = problem.basis();
  const auto derivative = parameter.derivative(problem.model());
  Matrix moved(basis.samples(), problem.model().coordinateCount());
  for (int i = 0; i < basis.samples(); ++i) {
    const double tau = 2 * std::numbers::pi * problem.drivePeriods() * i / basis.samples();
    moved.row(i) = derivative->prescribed(tau).transpose();
  }
  return (basis.analysis() * moved).cwiseProduct(byCoefficients).sum();
}

}  // namespace

DesignGradient designGradient(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion,
                              const DesignObjective& objective, const std::vector<int>& parameters,
                              const ParameterJacobian& jacobian) {
  const Model& model = problem.model();
  ObjectiveValue at = objective.evaluate(problem, motion.z);
  DesignGradient result{at.value, at.byParameters(parameters), true};
  const Vector byMotion = problem.withoutLeftOut(at.byCoefficients(Eigen::all, model.dofs.freeCoordinates).reshaped());
  at.byCoefficients(Eigen::all, model.dofs.freeCoordinates).setZero();
  const auto count = static_cast<Eigen::Index>(parameters.size());
  const auto parameterAt = [&](Eigen::Index i) -> const mechanics::DesignParameter& {
    return *model.parameters.at(static_cast<std::size_t>(parameters[static_cast<std::size_t>(i)]));
  };
  if (!at.byCoefficients.isZero(0))
    for (Eigen::Index i = 0; i < count; ++i)
      result.gradient[i] += prescribedWork(problem, at.byCoefficients, parameterAt(i));
  if (byMotion.isZero(0)) return result;
  const Vector adjoint = adjointOf(problem, motion, byMotion);
  if (adjoint.size() == 0) return {at.value, Vector::Zero(count), false};
  result.gradient -= jacobian.transposedTimes(adjoint);
  return result;
}

DesignGradient designGradient(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion,
                              const DesignObjective& objective, const std::vector<int>& parameters) {
  return designGradient(
      problem, motion, objective, parameters, ParameterJacobian(problem, motion.z, motion.omega, parameters));
}

}  // namespace pliant::harmonic
