#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/interlock/contact_terms.hpp"
#include "core/interlock/detail_search.hpp"
#include "core/math/parallel.hpp"

namespace pliant::interlock {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using MotionVector = Eigen::Matrix<double, 6, 1>;
using MotionMatrix = Eigen::Matrix<double, 6, 6>;

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
/// Of the tolerance: moves that concern the neighbours.
constexpr double wakingMove = 0.1;

Vector3d turnOf(const Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Matrix3d turnedBy(const Vector3d& turn, const Matrix3d& rotation) {
  const double angle = turn.norm();
  if (angle == 0) return rotation;
  const Eigen::Quaterniond by(Eigen::AngleAxisd(angle, turn / angle));
  return (by * Eigen::Quaterniond(rotation)).normalized().toRotationMatrix();
}

}  // namespace

double DetailSearch::energyOf(int element, const ElementPose& pose, MotionVector* gradient,
                              MotionMatrix* hessian) const {
  const auto index = static_cast<std::size_t>(element);
  const double perLength = 1 / (radius_ * radius_), turnPull = detailer_.options_.turnPull;
  const Vector3d away = pose.position - targets_[index].position;
  const Vector3d turn = turnOf(pose.rotation * targets_[index].rotation.transpose());
  double energy = 0.5 * perLength * away.squaredNorm() + 0.5 * turnPull * turn.squaredNorm();
  if (gradient) *gradient << perLength * away, turnPull * turn;
  if (hessian) {
    hessian->setZero();
    hessian->diagonal() << Vector3d::Constant(perLength), Vector3d::Constant(turnPull);
  }
  const CellContact::Barrier barrier{detailer_.options_.weight, range_};
  thread_local std::vector<std::array<int, 2>> near;
  ContactTerms terms;
  for (const int k : neighbours_[index]) {
    const Pair& pair = pairs_[static_cast<std::size_t>(k)];
    const bool isFirst = pair.a == element;
    const int other = isFirst ? pair.b : pair.a;
    const ElementPose& theirs = poses_[static_cast<std::size_t>(other)];
    const double touching = partsOf(element).reach() + partsOf(other).reach() + range_;
    const Vector3d offset = pose.position - theirs.position;
    if (offset.squaredNorm() >= touching * touching) continue;
    near.clear();
    appendNearParts(partsOf(element), pose.centres, partsOf(other), theirs.centres, offset, range_, near);
    for (const auto& [mine, their] : near) {
      const PlacedPart a = pose.part(partsOf(element), mine), b = theirs.part(partsOf(other), their);
      if (areApart(a, b, offset, a.part->radius + b.part->radius + range_)) continue;
      if (!terms.compute(a, b, offset, Eigen::Vector2d::Zero(), barrier, gradient != nullptr, hessian != nullptr))
        continue;
      if (!(terms.gap > 0)) return unbounded;
      energy += terms.value;
      if (gradient) *gradient += terms.gradient.head<6>();
      if (hessian) *hessian += terms.hessian.topLeftCorner<6, 6>();
    }
  }
  return energy;
}

double DetailSearch::relax(int element) {
  const auto index = static_cast<std::size_t>(element);
  ElementPose& pose = poses_[index];
  const double reach = partsOf(element).reach();
  MotionVector gradient;
  MotionMatrix hessian;
  const double energy = energyOf(element, pose, &gradient, &hessian);
  if (!std::isfinite(energy)) return 0;
  // In lengths: turns count by the way of the element's rim.
  MotionVector scale;
  scale << 1, 1, 1, 1 / reach, 1 / reach, 1 / reach;
  const Eigen::SelfAdjointEigenSolver<MotionMatrix> eigen(
      MotionMatrix(scale.asDiagonal() * hessian * scale.asDiagonal()));
  const Eigen::Array<double, 6, 1> curvatures =
      eigen.eigenvalues().array().abs().max(1e-6 * eigen.eigenvalues().cwiseAbs().maxCoeff());
  const MotionVector slope = scale.cwiseProduct(gradient);
  MotionVector step =
      -(eigen.eigenvectors() * ((eigen.eigenvectors().transpose() * slope).array() / curvatures).matrix());
  // Neighbours of other colours rest meanwhile, so that what moves is this element alone.
  double smallest = radiusOf(element);
  for (const double radius : detailer_.radii_) smallest = std::min(smallest, radius);
  const double farthest = std::min(pairMove * 2 * (radiusOf(element) + smallest), radius_);
  const double length = step.head<3>().norm() + step.tail<3>().norm();
  if (length > farthest) step *= farthest / length;
  const double descent = slope.dot(step);
  if (!(descent < 0)) return 0;
  for (double share = 1; share > 1e-3; share *= 0.5) {
    const ElementPose next(partsOf(element), pose.position + share * step.head<3>(),
                           turnedBy(share / reach * step.tail<3>(), pose.rotation));
    if (!(energyOf(element, next, nullptr, nullptr) <= energy + 1e-4 * share * descent)) continue;
    pose = next;
    return share * std::min(length, farthest);
  }
  return 0;
}

void DetailSearch::colour() {
  std::vector<int> colourOf(poses_.size(), -1);
  colours_.clear();
  std::vector<char> taken;
  for (int i = 0; i < count(); ++i) {
    taken.assign(colours_.size() + 1, 0);
    for (const int k : neighbours_[static_cast<std::size_t>(i)]) {
      const Pair& pair = pairs_[static_cast<std::size_t>(k)];
      const int other = colourOf[static_cast<std::size_t>(pair.a == i ? pair.b : pair.a)];
      if (other >= 0) taken[static_cast<std::size_t>(other)] = 1;
    }
    const auto own = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (own == colours_.size()) colours_.emplace_back();
    colours_[own].push_back(i);
    colourOf[static_cast<std::size_t>(i)] = static_cast<int>(own);
  }
}

double DetailSearch::sweep() {
  // Both of a pair may move, one after the other.
  findPairs(radius_);
  colour();
  std::vector<double> moves(poses_.size(), 0);
  for (const std::vector<int>& members : colours_)
    forElements(static_cast<int>(members.size()), [&](int i) {
      const int element = members[static_cast<std::size_t>(i)];
      if (awake_[static_cast<std::size_t>(element)]) moves[static_cast<std::size_t>(element)] = relax(element);
    });
  const double noticed = wakingMove * detailer_.options_.tolerance * radius_;
  std::fill(awake_.begin(), awake_.end(), 0);
  for (int i = 0; i < count(); ++i) {
    if (moves[static_cast<std::size_t>(i)] <= noticed) continue;
    awake_[static_cast<std::size_t>(i)] = 1;
    for (const int k : neighbours_[static_cast<std::size_t>(i)]) {
      awake_[static_cast<std::size_t>(pairs_[static_cast<std::size_t>(k)].a)] = 1;
      awake_[static_cast<std::size_t>(pairs_[static_cast<std::size_t>(k)].b)] = 1;
    }
  }
  return *std::max_element(moves.begin(), moves.end());
}

}  // namespace pliant::interlock
