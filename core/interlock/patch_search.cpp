#include "core/interlock/patch_search.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/interlock/contact_terms.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Matrix6 = PatchSystem::Matrix6;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// An element this far from where it was, over the size of the patch, is held by nothing.
constexpr double farthestShift = 20;

}  // namespace

PatchSearch::PatchSearch(const PatchSolver& solver, const CellState& start, const PatchLoads& loads,
                         const base::ExecutionContext* context)
    : BarrierDescent(solver.contact_, start, solver.radius_, context),
      system_(static_cast<int>(start.rotations.size())),
      solver_(solver),
      loads_(loads),
      onParaboloid_(false),
      clamped_(start.rotations.size(), false) {
  for (const int element : loads.clamped) clamped_[element] = true;
}

PatchSearch::PatchSearch(const PatchSolver& solver, const CellState& start, const StrainDrive& drive,
                         const base::ExecutionContext* context)
    : BarrierDescent(solver.contact_, start, solver.radius_, context),
      system_(static_cast<int>(start.rotations.size())),
      solver_(solver),
      drive_(drive),
      onParaboloid_(true),
      clamped_(start.rotations.size(), false),
      curvatureScale_(2 / (solver.extent_ * solver.extent_)) {
  system_.constraints.setZero(6 * Eigen::Index{count()}, 3);
  for (int i = 0; i < count(); ++i) {
    const Vector3d& rest = solver.patch().elements[i].position;
    restHeights_.push_back(rest.z());
    system_.constraints.block<2, 2>(6 * i, 0).setIdentity();
    system_.constraints(6 * i, 2) = -rest.y() / solver.extent_;
    system_.constraints(6 * i + 1, 2) = rest.x() / solver.extent_;
  }
}

CellState PatchSearch::advanced(const CellState& state, const VectorXd& velocity, double step) const {
  CellState next = moved(state, velocity, step);
  if (onParaboloid_)
    for (int i = 0; i < count(); ++i)
      next.positions(2, i) =
          restHeights_[i] + Paraboloid{next.strain}.height(next.positions(0, i), next.positions(1, i));
  return next;
}

double PatchSearch::objective(const CellState& state) const {
  if (onParaboloid_)
    return -travelled(state.strain) + 0.5 * drive_.spring * (state.strain - drive_.target).squaredNorm();
  double sum = 0;
  for (const auto& [element, force, arm] : loads_.forces)
    sum -= force.dot(state.positions.col(element) - start_.positions.col(element) + state.rotations[element] * arm);
  return sum;
}

double PatchSearch::linearize(const CellContact::Barrier& barrier, double& gap) {
  std::vector<std::array<int, 2>> near;
  for (const auto& [a, b, shift] : contact_.nearElements(state_, radius_)) near.push_back({a, b});
  // Contacts that lag behind may have moved apart since.
  if (friction_) friction_->visitPairs([&](int a, int b) { near.push_back({a, b}); });
  system_.begin(near, onParaboloid_ ? static_cast<int>(drive_.directions.cols()) : 0);
  gap = barrier.range;
  const auto add = [&](const PartPair& pair, const ContactTerms& terms) {
    system_.gradient.segment<6>(6 * pair.a) += terms.gradient.head<6>();
    system_.gradient.segment<6>(6 * pair.b) += terms.gradient.segment<6>(6);
    system_.diagonal(pair.a) += terms.hessian.topLeftCorner<6, 6>();
    system_.diagonal(pair.b) += terms.hessian.block<6, 6>(6, 6);
    system_.pair(pair.a, pair.b) += terms.hessian.block<6, 6>(0, 6);
  };
  const double energy =
      contact_.visitContacts(state_, pairs_, barrier, true, true, [&](const PartPair& pair, const ContactTerms& terms) {
        gap = std::min(gap, terms.gap);
        add(pair, terms);
      });
  if (!std::isfinite(energy)) return energy;
  addLoads();
  if (friction_) {
    friction_->visitContacts(state_, add);
    Vector6 drag;
    Matrix6 stiffness;
    for (int i = 0; i < count(); ++i) {
      friction_->elementDrag(state_, i, drag, stiffness);
      system_.gradient.segment<6>(6 * Eigen::Index{i}) += drag;
      system_.diagonal(i) += stiffness;
    }
  }
  reduceToUnknowns();
  return energy;
}

void PatchSearch::addLoads() {
  for (const auto& [element, force, bodyArm] : loads_.forces) {
    const Vector3d arm = state_.rotations[element] * bodyArm;
    system_.gradient.segment<3>(6 * element) -= force;
    system_.gradient.segment<3>(6 * element + 3) -= arm.cross(force);
    // Second derivative by the rotation vector of -force · (exp[w] arm).
    system_.diagonal(element).bottomRightCorner<3, 3>() -=
        0.5 * (force * arm.transpose() + arm * force.transpose()) - force.dot(arm) * Matrix3d::Identity();
  }
}

void PatchSearch::reduceToUnknowns() {
  const Paraboloid paraboloid{state_.strain};
  const auto columns = static_cast<Eigen::Index>(drive_.directions.cols());
  std::vector<Matrix6> change(count(), Matrix6::Identity());
  Eigen::MatrixXd heights(count(), columns);  // of the elements, by the border's unknowns
  Eigen::MatrixXd pushed = Eigen::MatrixXd::Zero(6 * Eigen::Index{count()}, columns);
  for (int i = 0; i < count(); ++i) {
    change[i].bottomRightCorner<3, 3>() /= contact_.partsOf(i).reach();
    if (clamped_[i]) change[i].setZero();
    if (!onParaboloid_) continue;
    const double x = state_.positions(0, i), y = state_.positions(1, i);
    change[i](2, 2) = 0;
    change[i].block<1, 2>(2, 0) = paraboloid.slope(x, y).transpose();
    heights.row(i) = curvatureScale_ * Paraboloid::ofCurvature(x, y).transpose() * drive_.directions;
  }
  const auto addPushed = [&](int element, const Matrix6& block, int by) {
    pushed.middleRows<6>(6 * element) += block.col(2) * heights.row(by);
  };
  for (int i = 0; i < count(); ++i) {
    if (onParaboloid_) addPushed(i, system_.diagonal(i), i);
    system_.diagonal(i) = (change[i].transpose() * system_.diagonal(i) * change[i]).eval();
  }
  system_.visitPairs([&](int a, int b, Matrix6& block) {
    if (onParaboloid_) {
      addPushed(a, block, b);
      addPushed(b, block.transpose(), a);
    }
    block = (change[a].transpose() * block * change[b]).eval();
  });
  for (int i = 0; i < count(); ++i) {
    const Vector6 own = system_.gradient.segment<6>(6 * i);
    system_.gradient.segment<6>(6 * i) = change[i].transpose() * own;
    for (int k = 0; k < 6; ++k)  // coordinates that count nothing
      if (change[i].col(k).isZero(0)) system_.diagonal(i)(k, k) = 1;
    if (!onParaboloid_) continue;
    const double x = state_.positions(0, i), y = state_.positions(1, i);
    system_.diagonal(i).topLeftCorner<2, 2>() += own[2] * paraboloid.second();
    system_.border.middleRows<6>(6 * i) = change[i].transpose() * pushed.middleRows<6>(6 * i);
    system_.border.middleRows<2>(6 * i) +=
        own[2] * curvatureScale_ * Paraboloid::slopeOfCurvature(x, y).transpose() * drive_.directions;
    system_.corner += heights.row(i).transpose() * pushed.row(6 * i + 2);
    system_.borderGradient += own[2] * heights.row(i).transpose();
  }
  if (!onParaboloid_) return;
  const Vector3d pull = drive_.spring * (state_.strain - drive_.target) - drive_.load;
  system_.borderGradient += curvatureScale_ * drive_.directions.transpose() * pull;
  system_.corner +=
      drive_.spring * curvatureScale_ * curvatureScale_ * drive_.directions.transpose() * drive_.directions;
}

VectorXd PatchSearch::direction() {
  double stiffest = 0;
  for (int i = 0; i < count(); ++i) stiffest = std::max(stiffest, system_.diagonal(i).diagonal().maxCoeff());
  // Motions that change nothing but rounding errors, as rotations of a ring about its axis, get this stiffness.
  const double least = std::max(1e-12 * stiffest, 1e-300);
  double shift = std::max(0.1 * shift_, least);
  VectorXd step, borderStep;
  for (int attempt = 0; attempt < 60; ++attempt) {
    if (!system_.solve(shift, step, borderStep)) {
      shift *= 10;
      continue;
    }
    double longest = borderStep.size() > 0 ? borderStep.norm() : 0;
    for (int i = 0; i < count(); ++i)
      longest = std::max(longest, step.segment<3>(6 * i).norm() + step.segment<3>(6 * i + 3).norm());
    if (longest <= 1.5 * trust_) break;
    shift *= std::clamp(longest / trust_, 1.5, 100.0);
  }
  shift_ = shift;
  decrement_ = -system_.gradient.dot(step) - system_.borderGradient.dot(borderStep);
  return velocityOf(step, borderStep);
}

VectorXd PatchSearch::velocityOf(const VectorXd& step, const VectorXd& borderStep) const {
  VectorXd velocity = VectorXd::Zero(6 * Eigen::Index{count()} + 3);
  const Paraboloid paraboloid{state_.strain};
  if (borderStep.size() > 0) velocity.tail<3>() = curvatureScale_ * drive_.directions * borderStep;
  for (int i = 0; i < count(); ++i) {
    if (clamped_[i]) continue;
    velocity.segment<3>(6 * i) = step.segment<3>(6 * i);
    velocity.segment<3>(6 * i + 3) = step.segment<3>(6 * i + 3) / contact_.partsOf(i).reach();
    if (!onParaboloid_) continue;
    const double x = state_.positions(0, i), y = state_.positions(1, i);
    velocity[6 * i + 2] =
        paraboloid.slope(x, y).dot(velocity.segment<2>(6 * i)) + Paraboloid::ofCurvature(x, y).dot(velocity.tail<3>());
  }
  return velocity;
}

VectorXd PatchSearch::pathBeyond(const VectorXd& velocity) const {
  VectorXd beyond = VectorXd::Zero(count());
  if (!onParaboloid_) return beyond;
  // The height along a step s is a cubic; its terms beyond the first, for s <= 1, are s times these at most.
  const Eigen::Matrix2d second = Paraboloid{state_.strain}.second(), rate = Paraboloid{velocity.tail<3>()}.second();
  for (int i = 0; i < count(); ++i) {
    const Vector2d place = state_.positions.col(i).head<2>(), speed = velocity.segment<2>(6 * i);
    beyond[i] =
        std::abs(0.5 * speed.dot(second * speed) + place.dot(rate * speed)) + std::abs(0.5 * speed.dot(rate * speed));
  }
  return beyond;
}

template <class Visit>
void PatchSearch::visitPaths(const VectorXd& velocity, Visit&& visit) const {
  const VectorXd beyond = pathBeyond(velocity);
  VectorXd own(count());
  for (int i = 0; i < count(); ++i)
    own[i] = beyond[i] + velocity.segment<3>(6 * i + 3).norm() * contact_.partsOf(i).reach();
  for (int b = 1; b < count(); ++b)
    for (int a = 0; a < b; ++a) {
      const double path = (velocity.segment<3>(6 * a) - velocity.segment<3>(6 * b)).norm() + own[a] + own[b];
      visit(path, (state_.positions.col(a) - state_.positions.col(b)).norm() - contact_.partsOf(a).reach() -
                      contact_.partsOf(b).reach());
    }
}

double PatchSearch::relativePath(const VectorXd& velocity, double reach) const {
  double longest = 0;
  visitPaths(velocity, [&](double path, double gap) {
    if (gap < reach) longest = std::max(longest, path);
  });
  return longest;
}

double PatchSearch::largestStep(const VectorXd& velocity, double range) const {
  double step = 1;
  // Elements that are far from each other may move farther, as long as they do not come within range.
  visitPaths(velocity, [&](double path, double gap) {
    const double allowed = std::max(pathLimit_, gap - range);
    if (path * step > allowed) step = allowed / path;
  });
  if (!onParaboloid_) return step;
  const double speed = drive_.load.dot(velocity.tail<3>());
  if (speed > 0) step = std::min(step, (drive_.farthest - travelled(state_.strain)) / speed);
  return step;
}

double PatchSearch::weightFor(double gap) const {
  if (!onParaboloid_) {
    Vector3d sum = Vector3d::Zero();
    double largest = 0;
    for (const PointLoad& load : loads_.forces) {
      sum += load.force;
      largest = std::max(largest, load.force.norm());
    }
    return std::max({sum.norm(), largest, 1e-300}) * gap;
  }
  const Vector3d pull = drive_.spring * (state_.strain - drive_.target) - drive_.load;
  return std::max(curvatureScale_ * (drive_.directions.transpose() * pull).norm(), 1e-300) * gap;
}

bool PatchSearch::hasReached() const {
  return onParaboloid_ && travelled(state_.strain) >= drive_.farthest * (1 - 1e-12);
}

bool PatchSearch::isUnlimited() const {
  for (int i = 0; i < count(); ++i) {
    const Vector3d place = state_.positions.col(i);
    if (onParaboloid_ && Paraboloid{state_.strain}.slope(place.x(), place.y()).norm() > steepestSlope) return true;
    if ((place - start_.positions.col(i)).norm() > farthestShift * solver_.extent_) return true;
  }
  return false;
}

}  // namespace pliant::interlock
