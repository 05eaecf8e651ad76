#include "core/harmonic/design_gradient.hpp"

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
  for (int i = 0; i < basis.samples(); ++i) moved.row(i) = derivative->prescribed(problem.samplePhases(i)).transpose();
  return (basis.analysis() * moved).cwiseProduct(byCoefficients).sum();
}

}  // namespace

Vector directDerivative(const HarmonicBalanceProblem& problem, const ObjectiveValue& at,
                        const std::vector<int>& parameters) {
  const Model& model = problem.model();
  Vector derivative = at.byParameters(parameters);
  Matrix byOthers = at.byCoefficients;
  byOthers(Eigen::all, model.dofs.freeCoordinates).setZero();
  if (!byOthers.isZero(0))
    for (std::size_t i = 0; i < parameters.size(); ++i)
      derivative[static_cast<Eigen::Index>(i)] +=
          prescribedWork(problem, byOthers, *model.parameters.at(static_cast<std::size_t>(parameters[i])));
  return derivative;
}

DesignGradient designGradient(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion,
                              const DesignObjective& objective, const std::vector<int>& parameters,
                              const ParameterJacobian& jacobian) {
  const Model& model = problem.model();
  const ObjectiveValue at = objective.evaluate(problem, motion.z);
  DesignGradient result{at.value, directDerivative(problem, at, parameters), true};
  const Vector byMotion = problem.withoutLeftOut(at.byCoefficients(Eigen::all, model.dofs.freeCoordinates).reshaped());
  if (byMotion.isZero(0)) return result;
  const Vector adjoint = adjointOf(problem, motion, byMotion);
  if (adjoint.size() == 0) return {at.value, Vector::Zero(result.gradient.size()), false};
  result.gradient -= jacobian.transposedTimes(adjoint);
  return result;
}

DesignGradient designGradient(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion,
                              const DesignObjective& objective, const std::vector<int>& parameters) {
  return designGradient(
      problem, motion, objective, parameters, ParameterJacobian(problem, motion.z, motion.omega, parameters));
}

}  // namespace pliant::harmonic
