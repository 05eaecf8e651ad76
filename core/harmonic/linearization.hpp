#pragma once

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// A model linearised about its static equilibrium under the steady part of its loads and drives:
/// M u'' + (D_α M + D_β K) u' + K u = f over the free coordinates' displacements u.
struct Linearization {
  Vector equilibrium;              ///< positions of all coordinates [m]
  SparseMatrix stiffness;          ///< K, free x free [N/m]
  SparseMatrix mass;               ///< M, free x free [kg]
  SparseMatrix couplingStiffness;  ///< free x all coordinates; only columns of coordinates that are not free
  SparseMatrix couplingMass;       ///< likewise
  base::SolverReport report;       ///< of the static equilibrium; the matrices are empty unless it converged
};

/// Fails with a sentence if there is no static equilibrium, if nothing holds the model somewhere (rigid-body modes), or
/// if the equilibrium found is not stable (K has a negative eigenvalue).
Linearization linearizeAtEquilibrium(const HarmonicBalanceProblem& problem, base::ExecutionContext& context);

/// Eigenvalues below 0 of a symmetric matrix, by Sylvester's law of inertia from its LDLᵀ factors; -1 if those do not
/// exist. Of K - σM it is the number of eigenvalues ω² < σ.
int countNegativeEigenvalues(const SparseMatrix& matrix);

}  // namespace pliant::harmonic
