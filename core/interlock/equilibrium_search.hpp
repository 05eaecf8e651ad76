#pragma once

#include "core/interlock/barrier_descent.hpp"

namespace pliant::interlock {

/// Coordinates of a velocity = this · unknowns, which are lengths: all elements but the translation of the first, and
/// the strain along the drive's directions.
Eigen::MatrixXd freeCoordinates(const CellContact& contact, const StrainDrive& drive, double latticeScale);

/// One solve of CellSolver: the state on its way.
class EquilibriumSearch final : public BarrierDescent {
 public:
  EquilibriumSearch(const CellSolver& solver, const CellState& start, const StrainDrive& drive,
                    const base::ExecutionContext* context);

 private:
  double objective(const CellState& state) const override;
  double linearize(const CellContact::Barrier& barrier, double& gap) override;
  Eigen::VectorXd direction() override;
  CellState advanced(const CellState& state, const Eigen::VectorXd& velocity, double step) const override {
    return moved(state, velocity, step);
  }
  double largestStep(const Eigen::VectorXd& velocity, double range) const override;
  double relativePath(const Eigen::VectorXd& velocity, double reach) const override;
  double weightFor(double gap) const override { return pull() * gap / solver_.latticeScale_; }
  bool hasReached() const override { return travelled(state_.strain) >= drive_.farthest * (1 - 1e-12); }
  bool isUnlimited() const override;

  /// Adds the objective's derivatives at state_; null where not wanted.
  void addObjective(Eigen::VectorXd& gradient, Eigen::MatrixXd* hessian) const;
  /// How hard the drive pulls at state_, per relative deformation.
  double pull() const;
  double travelled(const Eigen::Vector3d& strain) const { return drive_.load.dot(strain - start_.strain); }

  const CellSolver& solver_;
  const StrainDrive drive_;
  Eigen::MatrixXd basis_;     ///< freeCoordinates
  Eigen::VectorXd gradient_;  ///< by the coordinates, at state_
  Eigen::MatrixXd hessian_;
};

}  // namespace pliant::interlock
