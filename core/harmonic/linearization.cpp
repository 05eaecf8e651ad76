#include "core/harmonic/linearization.hpp"

#include <Eigen/SparseCholesky>

#include "core/solvers/static_equilibrium.hpp"

namespace pliant::harmonic {

namespace {

/// The rows of free coordinates of a matrix over all coordinates, cut into the columns of free ones and the others.
void splitByFreedom(const mechanics::DofMap& dofs, const SparseMatrix& all, SparseMatrix& free,
                    SparseMatrix& coupling) {
  std::vector<Eigen::Triplet<double>> freeEntries, couplingEntries;
  for (Eigen::Index column = 0; column < all.cols(); ++column)
    for (SparseMatrix::InnerIterator it(all, column); it; ++it) {
      const int row = dofs.freeIndex[it.row()];
      const int freeColumn = dofs.freeIndex[column];
      if (row < 0) continue;
      if (freeColumn >= 0)
        freeEntries.emplace_back(row, freeColumn, it.value());
      else
        couplingEntries.emplace_back(row, static_cast<int>(column), it.value());
    }
  free.resize(dofs.freeCount(), dofs.freeCount());
  free.setFromTriplets(freeEntries.begin(), freeEntries.end());
  coupling.resize(dofs.freeCount(), all.cols());
  coupling.setFromTriplets(couplingEntries.begin(), couplingEntries.end());
}

/// ∇²E over all coordinates, driven and locked ones included.
SparseMatrix wholeStiffness(const Model& model, const Vector& positions) {
  auto loose = std::make_shared<Model>(model);
  loose->drives.clear();
  loose->lockedCoordinates.assign(model.coordinateCount(), 0);
  loose->finish();
  return mechanics::ElasticAssembler(loose).hessian(positions);
}

}  // namespace

int countNegativeEigenvalues(const SparseMatrix& matrix) {
  const Eigen::SimplicialLDLT<SparseMatrix> factors(matrix);
  if (factors.info() != Eigen::Success) return -1;
  return static_cast<int>((factors.vectorD().array() < 0).count());
}

Linearization linearizeAtEquilibrium(const HarmonicBalanceProblem& problem, base::ExecutionContext& context) {
  const Model& model = problem.model();
  solvers::StaticEquilibrium found = solvers::solveStaticEquilibrium(
      model, problem.assembler(), problem.steadyConfiguration(), problem.steadyForce(), {}, context);
  Linearization result;
  result.equilibrium = std::move(found.positions);
  result.report = std::move(found.report);
  if (!result.report.converged()) return result;
  splitByFreedom(model.dofs, wholeStiffness(model, result.equilibrium), result.stiffness, result.couplingStiffness);
  splitByFreedom(model.dofs, model.massMatrix(), result.mass, result.couplingMass);
  if (countNegativeEigenvalues(result.stiffness) != 0) {
    result.report.termination = base::TerminationType::failed;
    result.report.message =
        "The static equilibrium is not stable, so that no small motion stays near it; disturb the rest shape so that "
        "the structure falls to one side.";
  }
  return result;
}

}  // namespace pliant::harmonic
