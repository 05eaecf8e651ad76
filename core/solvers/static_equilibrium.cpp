#include "core/solvers/static_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pliant::solvers {

namespace {

using mechanics::ElasticAssembler;
using mechanics::Model;
using mechanics::SparseMatrix;
using mechanics::Vector;

/// A direction that the stiffness resists by less than this fraction of its largest entry counts as free.
constexpr double negligibleStiffness = 1e-14;

/// Of the diagonal, relative to the stiffness's largest entry: below the softest bending, above everything.
constexpr double smallestShift = 1e-12;
constexpr double largestShift = 1e3;

/// Steps back to what stiff links and sheets allow after a step beside it, and the shift of the diagonal that leaves
/// only their stiffness in charge, relative to the stiffness's largest entry.
constexpr int mostRelaxations = 6;
constexpr double relaxationShift = 1e-3;

double largestEntry(const SparseMatrix& matrix) {
  double largest = 0;
  for (Eigen::Index i = 0; i < matrix.nonZeros(); ++i) largest = std::max(largest, std::abs(matrix.valuePtr()[i]));
  return largest;
}

SparseMatrix shifted(const SparseMatrix& matrix, double shift) {
  SparseMatrix result = matrix;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) result.coeffRef(i, i) += shift;
  return result;
}

}  // namespace

std::string describeMissingStiffness(const Model& model, const ElasticAssembler& assembler, const Vector& positions) {
  const SparseMatrix stiffness = assembler.hessian(positions);
  const double largest = largestEntry(stiffness);
  const int count = model.dofs.freeCount();
  int loose = 0;
  Vector softest = Vector::Zero(count);
  const Vector diagonal = stiffness.diagonal();
  for (int i = 0; i < count; ++i)
    if (!(std::abs(diagonal[i]) > negligibleStiffness * largest)) {
      softest[i] = 1;
      ++loose;
    }
  if (loose == 0) {
    // Inverse iteration; the shift keeps the matrix regular and leaves directions without stiffness in front.
    math::SparseFactorization factorization;
    double shift = 100 * negligibleStiffness;
    while (!factorization.factorize(shifted(stiffness, shift * largest)))
      if ((shift *= 10) > 1) return "The stiffness of the structure is not finite.";
    for (int i = 0; i < count; ++i) softest[i] = 1 + 0.5 * std::sin(1.0 + i);  // no symmetry that a mode could have
    for (int iteration = 0; iteration < 4; ++iteration) softest = factorization.solve(softest.normalized()).col(0);
    softest.normalize();
    if ((stiffness * softest).norm() > negligibleStiffness * largest) return {};
  }
  Eigen::Index worst = 0;
  softest.cwiseAbs().maxCoeff(&worst);
  const int coordinate = model.dofs.freeCoordinates[worst];
  const int axis = coordinate % model.dimension;
  const std::string axisName(1, "xyz"[axis]);
  std::string sentence = "Nothing holds node " + std::to_string(coordinate / model.dimension) + " along " + axisName;
  if (loose == 0)
    return sentence +
           ": the structure can move there without being deformed, as a sheet turns about a single line of "
           "nodes that holds it; drive, lock or support more of it.";
  if (loose > 1) {
    int sameAxis = -1;
    for (int i = 0; i < count; ++i)
      sameAxis += softest[i] != 0 && model.dofs.freeCoordinates[i] % model.dimension == axis;
    if (sameAxis > 0) sentence += " (nor " + std::to_string(sameAxis) + " more nodes)";
  }
  return sentence + ": its stiffness there is zero at rest; lock that coordinate, or hold it by bending stiffness, " +
         "tension or a spring.";
}

StaticEquilibrium solveStaticEquilibrium(const Model& model, const ElasticAssembler& assembler, const Vector& start,
                                         const Vector& force, const StaticEquilibriumOptions& options,
                                         base::ExecutionContext& context) {
  using base::TerminationType;
  const auto& free = model.dofs.freeCoordinates;
  const double size = std::max(start.cwiseAbs().maxCoeff(), 1e-300);
  const Vector load = force(free);
  const auto potential = [&](const Vector& x) { return assembler.value(x) - load.dot(x(free)); };
  const auto unbalanced = [&](const Vector& x) -> Vector { return (assembler.gradient(x) - force)(free); };

  StaticEquilibrium result;
  Vector& x = result.positions;
  x = start;
  Vector residual = unbalanced(x);
  double energy = potential(x);
  const double scale = std::max({load.norm(), residual.norm(), 1e-300});
  double shift = 0;  // relative to the stiffness's largest entry
  bool moved = true;
  SparseMatrix stiffness;
  double largest = 0;
  math::SparseFactorization factorization;
  result.report.iterations.push_back({0, residual.norm() / scale, 0});

  // A step along the tangent of stiff links or an inextensible sheet ends beside what they allow, by the square of its
  // length: it seems to raise the energy however far it leads down the valley, and the stress of the stretch spoils the
  // next Hessian. Steps with a shift that only stiff directions overcome lead back.
  const auto relaxStiffDirections = [&](Vector& position, Vector& left) {
    for (int i = 0; i < mostRelaxations; ++i) {
      const SparseMatrix matrix = assembler.hessian(position);
      if (!factorization.factorize(shifted(matrix, relaxationShift * largestEntry(matrix)))) return;
      Vector relaxed = position;
      relaxed(free) -= factorization.solve(left).col(0);
      const Vector next = unbalanced(relaxed);
      if (!(next.norm() < 0.5 * left.norm())) return;
      position = relaxed;
      left = next;
    }
  };

  const auto iterate = [&](int iteration) -> std::optional<TerminationType> {
    if (!std::isfinite(energy)) return TerminationType::failed;
    if (residual.norm() <= options.tolerance * scale) return TerminationType::converged;
    if (context.cancelRequested()) return TerminationType::cancelled;
    if (moved) {
      stiffness = assembler.hessian(x);
      largest = largestEntry(stiffness);
    }
    // What rounding of the positions makes of the elastic forces.
    if (residual.norm() <= 1e-15 * largest * size * std::sqrt(static_cast<double>(free.size())))
      return TerminationType::converged;
    moved = false;
    Vector step;
    if (factorization.factorize(shift > 0 ? shifted(stiffness, shift * largest) : stiffness))
      step = -factorization.solve(residual).col(0);
    if (step.size() > 0 && step.dot(residual) < 0) {
      const bool tiny = step.norm() <= options.stepTolerance * size;
      Vector trial = x;
      trial(free) += step;
      Vector trialResidual = unbalanced(trial);
      if (!tiny && trialResidual.norm() > residual.norm()) relaxStiffDirections(trial, trialResidual);
      const double trialEnergy = potential(trial);
      // Near the end the energy's decrease drowns in rounding, and the force's does not.
      if (trialEnergy < energy || (shift == 0 && trialResidual.norm() < residual.norm())) {
        x = trial;
        residual = trialResidual;
        energy = trialEnergy;
        moved = true;
        result.report.iterations.push_back({iteration, residual.norm() / scale, 1});
      }
      if (tiny && shift == 0) return TerminationType::converged;
    }
    shift = moved ? (shift > smallestShift ? 0.1 * shift : 0) : std::max(10 * shift, smallestShift);
    if (shift > largestShift) return TerminationType::failed;
    return std::nullopt;
  };

  std::optional<TerminationType> end;
  for (int iteration = 1; !end; ++iteration)
    end = iteration > options.maximumIterations ? TerminationType::iterationLimit : iterate(iteration);
  result.report.termination = *end;
  if (*end == TerminationType::cancelled) {
    result.report.message = "The search for the static equilibrium was cancelled.";
  } else if (std::string missing = describeMissingStiffness(model, assembler, x); !missing.empty()) {
    result.report.termination = TerminationType::failed;
    result.report.message = std::move(missing);
  } else if (*end != TerminationType::converged) {
    result.report.message = "No static equilibrium under the steady load was found.";
  }
  return result;
}

}  // namespace pliant::solvers
