#include "core/solvers/static_equilibrium.hpp"

#include <algorithm>
#include <cmath>

#include "core/solvers/continuation_solver.hpp"
#include "core/solvers/newton_solver.hpp"

namespace pliant::solvers {

namespace {

using mechanics::ElasticAssembler;
using mechanics::Model;
using mechanics::SparseMatrix;
using mechanics::Vector;

/// A direction that the stiffness resists by less than this fraction of its largest entry counts as free.
constexpr double negligibleStiffness = 1e-14;

/// ∇E(x) - f = (1 - λ) (∇E(x₀) - f) over the free coordinates: solved by x₀ at λ = 0 and by the equilibrium at λ = 1.
class LoadedStructure final : public NonlinearSystem, public ContinuationProblem {
 public:
  LoadedStructure(const Model& model, const ElasticAssembler& assembler, const Vector& start, const Vector& force)
      : free_(model.dofs.freeCoordinates),
        assembler_(assembler),
        positions_(start),
        force_(force(free_)),
        imbalance_(assembler.gradient(start)(free_) - force_) {}

  Vector positions(const Vector& x) {
    positions_(free_) = x;
    return positions_;
  }
  double forceScale() const {
    const double scale = std::max(force_.norm(), imbalance_.norm());
    return scale > 0 ? scale : 1.0;
  }

  Vector residual(const Vector& x) override { return assembler_.gradient(positions(x))(free_) - force_; }
  bool linearize(const Vector& x, Vector& r) override {
    r = residual(x);
    stiffness_ = assembler_.hessian(positions(x));
    return factorization_.factorize(stiffness_);
  }

  Vector residual(const Vector& x, double parameter) override { return residual(x) - (1 - parameter) * imbalance_; }
  double residualScale(double) override { return forceScale(); }
  Vector linearize(const Vector& x, double) override {
    stiffness_ = assembler_.hessian(positions(x));
    return imbalance_;
  }
  Vector multiply(const Vector& v) override { return stiffness_ * v; }
  bool factorize() override { return factorization_.factorize(stiffness_); }

  Vector solve(const Vector& b) override { return factorization_.solve(b); }  // of both interfaces

 private:
  const std::vector<int>& free_;
  const ElasticAssembler& assembler_;
  Vector positions_;
  Vector force_;
  Vector imbalance_;
  SparseMatrix stiffness_;
  math::SparseFactorization factorization_;
};

double modelSize(const Vector& positions) { return std::max(positions.cwiseAbs().maxCoeff(), 1e-300); }

base::SolverReport rampLoad(LoadedStructure& structure, Vector& x, double size,
                            const StaticEquilibriumOptions& options, base::ExecutionContext& context) {
  ContinuationOptions ramp;
  ramp.stateScale = size;
  ramp.initialStep = 0.1;
  ramp.targetAngle = 0.3;
  ramp.maximumAngle = 1.0;
  ramp.tolerance = options.tolerance;
  ramp.stepTolerance = options.stepTolerance;
  ramp.maximumPoints = options.maximumRampSteps;
  // Only the end counts, so the range is open to the other side: the branch may turn back on its way.
  ramp.lower = -1;
  ContinuationSolver solver(structure, ramp);
  BranchPoint last;
  base::SolverReport report =
      solver.trace(x, 0, context, [&](const BranchPoint& point, BranchEvent, int) { last = point; });
  if (report.converged() && last.parameter < 1) {
    report.termination = base::TerminationType::failed;
    report.message = "The load could not be ramped up.";
  }
  x = last.x;
  return report;
}

}  // namespace

std::string describeMissingStiffness(const Model& model, const ElasticAssembler& assembler, const Vector& positions) {
  const SparseMatrix stiffness = assembler.hessian(positions);
  double largest = 0;
  for (Eigen::Index i = 0; i < stiffness.nonZeros(); ++i)
    largest = std::max(largest, std::abs(stiffness.valuePtr()[i]));
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
    // Inverse iteration; the shift keeps the factors finite and leaves the softest direction in front.
    SparseMatrix shifted = stiffness;
    math::SparseFactorization factorization;
    for (int i = 0; i < count; ++i) shifted.coeffRef(i, i) += 0.1 * negligibleStiffness * largest;
    for (int i = 0; i < count; ++i) softest[i] = 1 + 0.5 * std::sin(1.0 + i);  // no symmetry that a mode could have
    if (factorization.factorize(shifted))
      for (int iteration = 0; iteration < 3; ++iteration)
        softest = factorization.solve(softest.normalized()).col(0);
    if (!softest.allFinite()) return "The stiffness of the structure is not finite.";
    softest.normalize();
    if ((stiffness * softest).norm() > negligibleStiffness * largest) return {};
  }
  Eigen::Index worst = 0;
  softest.cwiseAbs().maxCoeff(&worst);
  const int coordinate = model.dofs.freeCoordinates[worst];
  const int axis = coordinate % model.dimension;
  const std::string axisName(1, "xyz"[axis]);
  std::string sentence = "Nothing holds node " + std::to_string(coordinate / model.dimension) + " along " + axisName;
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
  LoadedStructure structure(model, assembler, start, force);
  const double size = modelSize(start);
  NewtonOptions newton;
  newton.tolerance = options.tolerance;
  newton.residualScale = structure.forceScale();
  newton.stepTolerance = options.stepTolerance;
  newton.stepScale = size;
  newton.roundingTolerance = 10 * options.stepTolerance;
  newton.maximumIterations = options.maximumIterations;

  StaticEquilibrium result;
  const Vector rest = start(model.dofs.freeCoordinates);
  Vector x = rest;
  result.report = solveNewton(structure, x, newton, context);
  if (!result.report.converged() && result.report.termination != base::TerminationType::cancelled) {
    if (std::string missing = describeMissingStiffness(model, assembler, start); !missing.empty()) {
      result.report.termination = base::TerminationType::failed;
      result.report.message = std::move(missing);
    } else {
      x = rest;
      result.report = rampLoad(structure, x, size, options, context);
      if (result.report.converged() == false && result.report.termination != base::TerminationType::cancelled)
        result.report.message = "No static equilibrium under the steady load was found.";
    }
  }
  result.positions = structure.positions(x);
  if (result.report.converged()) {
    if (std::string missing = describeMissingStiffness(model, assembler, result.positions); !missing.empty()) {
      result.report.termination = base::TerminationType::failed;
      result.report.message = std::move(missing);
    }
  }
  return result;
}

}  // namespace pliant::solvers
