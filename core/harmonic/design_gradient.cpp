#include "core/harmonic/design_gradient.hpp"

#include <numbers>

#include "core/harmonic/jacobian_solver.hpp"
#include "core/harmonic/refined_solve.hpp"
#include "core/mechanics/stiffness_factor.hpp"

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

/// λᵀ ∂h/∂p for parameters one after the other.
class ParameterWork {
 public:
  ParameterWork(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion, const Vector& adjoint)
      : problem_(problem), motion_(motion), adjoint_(adjoint), positions_(problem.trajectories(motion.z)) {
    // λᵀ (1 + D_β ω d) analysis g = Σ over samples of (virtual displacement) · g.
    const Model& model = problem.model();
    const math::HarmonicBasis& basis = problem.basis();
    const double omega = motion.omega / problem.drivePeriods();
    const Eigen::Map<const Matrix> lambda(adjoint.data(), basis.size(), model.dofs.freeCount());
    const Matrix virtualMotion = lambda - model.stiffnessDamping * omega * basis.derivative(lambda);
    displacements_.setZero(basis.samples(), model.coordinateCount());
    displacements_(Eigen::all, model.dofs.freeCoordinates) = basis.analysis().transpose() * virtualMotion;
  }

  double of(const mechanics::DesignParameter& parameter) const {
    const auto derivative = parameter.derivative(problem_.model());
    const auto* elastic = dynamic_cast<const mechanics::ElasticDerivative*>(derivative.get());
    if (!elastic) return adjoint_.dot(problem_.parameterDerivative(motion_.z, motion_.omega, parameter));
    const Matrix gradient = elastic->coordinateGradient(positions_);
    double work = 0;
    for (std::size_t i = 0; i < elastic->coordinates().size(); ++i)
      work += gradient.col(static_cast<Eigen::Index>(i)).dot(displacements_.col(elastic->coordinates()[i]));
    return work;
  }

 private:
  const HarmonicBalanceProblem& problem_;
  const PeriodicMotion& motion_;
  const Vector& adjoint_;
  Matrix positions_;      ///< N x coordinates
  Matrix displacements_;  ///< likewise
};

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
                              const DesignObjective& objective, const std::vector<int>& parameters) {
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
  const ParameterWork work(problem, motion, adjoint);
  for (Eigen::Index i = 0; i < count; ++i) result.gradient[i] -= work.of(parameterAt(i));
  return result;
}

}  // namespace pliant::harmonic
