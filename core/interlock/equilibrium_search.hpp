#pragma once

#include "core/interlock/cell_equilibrium.hpp"

namespace pliant::interlock {

/// One solve of CellSolver: the state on its way.
class EquilibriumSearch {
 public:
  EquilibriumSearch(const CellSolver& solver, const CellState& start, const StrainDrive& drive,
                    const base::ExecutionContext* context);

  CellEquilibrium run();
  /// The barrier alone, at its widest.
  CellState relax();

 private:
  enum class Outcome { minimum, reached, unlimited, noProgress, iterationLimit, cancelled };

  /// Newton's method for one barrier.
  Outcome minimize(const CellContact::Barrier& barrier, double tolerance);
  double objective(const CellState& state) const;
  /// Adds the objective's derivatives at state_; null where not wanted.
  void addObjective(Eigen::VectorXd& gradient, Eigen::MatrixXd* hessian) const;
  /// How hard the drive pulls at state_, per relative deformation.
  double pull() const;
  /// Newton's direction as a velocity; `decrement` gets -gradient · direction.
  Eigen::VectorXd direction(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian, double& decrement) const;
  /// How far two points of elements or images that are near each other move relative to one another at most [m], for
  /// a step of the whole velocity.
  double relativePath(const Eigen::VectorXd& velocity, double reach) const;
  /// The largest step that passes nothing by and keeps the lattice far from collapse.
  double largestStep(const Eigen::VectorXd& velocity, double range) const;
  double travelled(const Eigen::Vector3d& strain) const { return drive_.load.dot(strain - start_.strain); }
  bool isUnlimited() const;
  void measure(const CellContact::Barrier& barrier, CellEquilibrium& result);

  const CellSolver& solver_;
  const CellContact& contact_;
  const CellState start_;
  const StrainDrive drive_;
  const base::ExecutionContext* context_;
  /// Coordinates = basis · unknowns, which are lengths: all elements but the translation of the first, and the strain
  /// along the drive's directions.
  Eigen::MatrixXd basis_;
  double pathLimit_;  ///< [m]
  double trust_;      ///< longest step along an eigenvector [m]
  CellState state_;
  std::vector<PartPair> pairs_;  ///< near enough for the barrier at state_
  double decrement_ = 0;         ///< Newton's, at the last point looked at
  int iterations_ = 0;
};

}  // namespace pliant::interlock
