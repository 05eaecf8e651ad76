#include "core/harmonic/amplitude.hpp"

#include <algorithm>
#include <numbers>

#include "core/harmonic/path_length.hpp"
#include "core/mechanics/strain.hpp"

namespace pliant::harmonic {

Amplitude amplitude(const HarmonicBalanceProblem& problem, const Vector& z, int node) {
  const Matrix coefficients = nodeCoefficients(problem, z, node);
  return {pathLength(problem.basis(), coefficients), maximumDisplacement(problem.basis(), coefficients)};
}

Vector pathLengthGradient(const HarmonicBalanceProblem& problem, const Vector& z, int node) {
  const int dimension = problem.model().dimension;
  const Eigen::Index width = problem.basis().size();
  Matrix byPosition;
  pathLength(problem.basis(), nodeCoefficients(problem, z, node), &byPosition);
  Vector gradient = Vector::Zero(problem.size());
  for (int axis = 0; axis < dimension; ++axis) {
    const int f = problem.model().dofs.freeIndex[node * dimension + axis];
    if (f >= 0) gradient.segment(f * width, width) = byPosition.col(axis);
  }
  return gradient;
}

double largestStrain(const HarmonicBalanceProblem& problem, const Vector& z) {
  // A solver may take so few samples that a sheet is stretched more between them than at them.
  constexpr int fewestInstants = 64;
  const Model& model = problem.model();
  if (!mechanics::largestStrain(model, model.restPositions)) return 0;
  const int instants = std::max(fewestInstants, problem.basis().samples());
  double largest = 0;
  if (problem.basis().hasTwoFrequencies()) {
    const Matrix positions = problem.trajectories(z);
    for (Eigen::Index i = 0; i < positions.rows(); ++i)
      largest = std::max(largest, mechanics::largestStrain(model, positions.row(i).transpose()).value_or(0));
    return largest;
  }
  for (int i = 0; i < instants; ++i) {
    const Vector positions = problem.configurationAt(z, 2 * std::numbers::pi * i / instants);
    largest = std::max(largest, mechanics::largestStrain(model, positions).value_or(0));
  }
  return largest;
}

}  // namespace pliant::harmonic
