#include "core/interlock/equilibrium_search.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace pliant::interlock {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double smallestStretch = 0.05, largestStretch = 20;

}  // namespace

MatrixXd freeCoordinates(const CellContact& contact, const StrainDrive& drive, double latticeScale) {
  const int size = contact.coordinateCount(), elements = (size - 3) / 6;
  const int free = static_cast<int>(drive.directions.cols());
  MatrixXd basis = MatrixXd::Zero(size, 6 * elements - 3 + free);
  for (int i = 3; i < 6 * elements; ++i) basis(i, i - 3) = i % 6 < 3 ? 1 : 1 / contact.partsOf(i / 6).reach();
  for (int k = 0; k < free; ++k)
    basis.block<3, 1>(size - 3, 6 * elements - 3 + k) = drive.directions.col(k) / latticeScale;
  return basis;
}

EquilibriumSearch::EquilibriumSearch(const CellSolver& solver, const CellState& start, const StrainDrive& drive,
                                     const base::ExecutionContext* context)
    : BarrierDescent(solver.contact_, start, solver.radius_, context), solver_(solver), drive_(drive) {
  basis_ = freeCoordinates(contact_, drive, solver.latticeScale_);
}

double EquilibriumSearch::objective(const CellState& state) const {
  double sum = -travelled(state.strain) + 0.5 * drive_.spring * (state.strain - drive_.target).squaredNorm();
  for (const ElementPull& pull : drive_.pulls)
    sum += energyOf(contact_.cell(), state, pull, placeOf(contact_.cell(), start_, pull));
  return sum;
}

void EquilibriumSearch::addObjective(VectorXd& gradient, MatrixXd* hessian) const {
  gradient.tail<3>() += drive_.spring * (state_.strain - drive_.target) - drive_.load;
  if (hessian) hessian->diagonal().tail<3>().array() += drive_.spring;
  for (const ElementPull& pull : drive_.pulls) addDerivatives(contact_.cell(), state_, pull, gradient, hessian);
}

double EquilibriumSearch::pull() const {
  VectorXd gradient = VectorXd::Zero(contact_.coordinateCount());
  addObjective(gradient, nullptr);
  // The basis has lengths for unknowns.
  return std::max((basis_.transpose() * gradient).norm() * solver_.latticeScale_, 1e-300);
}

double EquilibriumSearch::linearize(const CellContact::Barrier& barrier, double& gap) {
  const double energy = contact_.energy(state_, pairs_, barrier, &gradient_, &hessian_, &gap);
  addObjective(gradient_, &hessian_);
  if (friction_) friction_->addDerivatives(state_, gradient_, hessian_);
  return energy;
}

VectorXd EquilibriumSearch::direction() {
  const VectorXd reduced = basis_.transpose() * gradient_;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(basis_.transpose() * hessian_ * basis_);
  // Along soft directions, and those that change nothing but rounding errors, as rotations of a ring about its axis,
  // steps end at the trust radius. Others keep their full length, so that gaps can settle while elements slide.
  const VectorXd along = solver.eigenvectors().transpose() * reduced;
  const VectorXd values = solver.eigenvalues().cwiseAbs().cwiseMax(along.cwiseAbs() / trust_);
  const VectorXd step = (values.array() > 0).select(-along.array() / values.array(), 0.0).matrix();
  decrement_ = -along.dot(step);
  return basis_ * (solver.eigenvectors() * step);
}

double EquilibriumSearch::relativePath(const VectorXd& velocity, double reach) const {
  double farthestOwn = 0, widest = 0, extent = 0;
  for (int i = 0; i < state_.positions.cols(); ++i) {
    const double own = contact_.partsOf(i).reach();
    farthestOwn =
        std::max(farthestOwn, velocity.segment<3>(6 * i).norm() + velocity.segment<3>(6 * i + 3).norm() * own);
    widest = std::max(widest, own);
    extent = std::max(extent, (state_.positions.col(i) - state_.positions.col(0)).norm());
  }
  const Eigen::Matrix2d rate = stretchOf(velocity.tail<3>()) - Eigen::Matrix2d::Identity();
  // Of an image at the translation T: |dF F⁻¹ T|, and T is not longer than what lies between.
  return 2 * farthestOwn + (rate * stretchOf(state_.strain).inverse()).norm() * (reach + 2 * widest + 2 * extent);
}

double EquilibriumSearch::largestStep(const VectorXd& velocity, double range) const {
  // Images farther away than `reach` get no nearer than the range: of their distance d a step takes pathLimit_ and
  // d / 2 at most.
  const double reach = 2 * (range + pathLimit_);
  double step = std::min(1.0, pathLimit_ / relativePath(velocity, reach));
  const Eigen::Matrix2d rate = stretchOf(velocity.tail<3>()) - Eigen::Matrix2d::Identity();
  const double relative = (rate * stretchOf(state_.strain).inverse()).norm();
  if (relative * step > 0.4) step = 0.4 / relative;
  const double speed = drive_.load.dot(velocity.tail<3>());
  if (speed > 0) step = std::min(step, (drive_.farthest - travelled(state_.strain)) / speed);
  return step;
}

bool EquilibriumSearch::isUnlimited() const {
  const auto stretches = stretchOf(state_.strain).selfadjointView<Eigen::Lower>().eigenvalues().eval();
  const double farthest = (state_.positions - start_.positions).cwiseAbs().maxCoeff();
  return stretches.minCoeff() < smallestStretch || stretches.maxCoeff() > largestStretch ||
         farthest > largestStretch * solver_.latticeScale_ * stretches.maxCoeff();
}

}  // namespace pliant::interlock
