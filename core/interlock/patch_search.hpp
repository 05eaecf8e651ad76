#pragma once

#include "core/interlock/barrier_descent.hpp"
#include "core/interlock/paraboloid.hpp"
#include "core/interlock/patch_equilibrium.hpp"
#include "core/interlock/patch_system.hpp"

namespace pliant::interlock {

/// One solve of PatchSolver: the state on its way.
class PatchSearch : public BarrierDescent {
 public:
  /// Under loads.
  PatchSearch(const PatchSolver& solver, const CellState& start, const PatchLoads& loads,
              const base::ExecutionContext* context);
  /// On a paraboloid.
  PatchSearch(const PatchSolver& solver, const CellState& start, const StrainDrive& drive,
              const base::ExecutionContext* context);

  CellState advanced(const CellState& state, const Eigen::VectorXd& velocity, double step) const override;

 protected:
  double objective(const CellState& state) const override;
  double linearize(const CellContact::Barrier& barrier, double& gap) override;
  /// Velocities of elements in space and of the curvature, of the unknowns of system_.
  Eigen::VectorXd velocityOf(const Eigen::VectorXd& step, const Eigen::VectorXd& borderStep) const;

  /// Derivatives are first gathered by the elements' velocities, six each, then by lengths: translation, of which on a
  /// paraboloid the third counts nothing, and rotation vector times the element's reach. The border's unknowns are the
  /// curvatures along the drive's directions, as lengths.
  PatchSystem system_;

 private:
  Eigen::VectorXd direction() override;
  double largestStep(const Eigen::VectorXd& velocity, double range) const override;
  double relativePath(const Eigen::VectorXd& velocity, double reach) const override;
  double weightFor(double gap) const override;
  bool hasReached() const override;
  bool isUnlimited() const override;

  double travelled(const Eigen::Vector3d& strain) const { return drive_.load.dot(strain - start_.strain); }
  int count() const { return static_cast<int>(state_.rotations.size()); }
  void addLoads();
  /// From velocities of elements in space to the unknowns: see unknowns_.
  void reduceToUnknowns();
  /// Because the paraboloid is curved.
  Eigen::VectorXd pathBeyond(const Eigen::VectorXd& velocity) const override;
  /// Calls visit(path, gap of the balls around them) for all pairs of elements: see relativePath.
  template <class Visit>
  void visitPaths(const Eigen::VectorXd& velocity, Visit&& visit) const;

  const PatchSolver& solver_;
  const PatchLoads loads_;
  const StrainDrive drive_;
  const bool onParaboloid_;
  std::vector<bool> clamped_;
  std::vector<double> restHeights_;
  double curvatureScale_ = 1;  ///< curvature [1/m] of an unknown of 1 m
  double shift_ = 0;           ///< of the last direction
};

}  // namespace pliant::interlock
