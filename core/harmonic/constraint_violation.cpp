#include "core/harmonic/constraint_violation.hpp"

#include "core/mechanics/mechanism.hpp"

namespace pliant::harmonic {

Vector constraintViolations(const HarmonicBalanceProblem& problem, const Vector& z) {
  const Model& model = problem.model();
  if (!mechanics::constraintViolation(model, model.restPositions)) return {};
  const Matrix positions = problem.trajectories(z);
  Vector violations(positions.rows());
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    violations[i] = mechanics::constraintViolation(model, positions.row(i)).value_or(0);
  return violations;
}

}  // namespace pliant::harmonic
