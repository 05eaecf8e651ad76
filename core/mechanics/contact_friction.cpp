#include "core/mechanics/contact_friction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>

#include "core/mechanics/checks.hpp"
#include "core/mechanics/creep_law.hpp"

namespace pliant::mechanics {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Contacts that push less than this, over the strongest, have no friction worth computing.
constexpr double leastPush = 1e-7;

}  // namespace

ContactFriction::ContactFriction(ContactBarrier& barrier, Matrix3Xd before, const Matrix3Xd& touching,
                                 const FrictionOptions& options)
    : before_(std::move(before)), creep_(options.creep), deformableCount_(barrier.primitives().deformableCount()) {
  requireNotNegative(options.coefficient, "the coefficient of friction");
  requirePositive(options.creep, "the creep of contacts");
  assert(before_.cols() == touching.cols());
  if (options.coefficient == 0) return;
  barrier.update(touching);
  const std::vector<Contact> contacts = barrier.contacts();
  double strongest = 0;
  for (const Contact& contact : contacts) strongest = std::max(strongest, contact.force.norm());
  for (const Contact& contact : contacts) {
    const double push = contact.force.norm();
    if (!(push > leastPush * strongest)) continue;
    geometry::Corners corners = geometry::Corners::Zero();
    for (int i = 0; i < geometry::cornerCount(contact.pair.kind); ++i)
      corners.col(i) = touching.col(contact.pair.nodes[i]);
    Touch& touch = contacts_.emplace_back();
    touch.pair = contact.pair;
    touch.weights = geometry::closestPoints(contact.pair.kind, corners).weights;
    touch.tangents.col(0) = contact.force.unitOrthogonal();
    touch.tangents.col(1) = (contact.force / push).cross(touch.tangents.col(0));
    touch.force = options.coefficient * push;
  }
}

Vector2d ContactFriction::slideOf(const Touch& touch, const Matrix3Xd& x) const {
  Vector3d moved = Vector3d::Zero();
  for (int i = 0; i < geometry::cornerCount(touch.pair.kind); ++i)
    moved += touch.weights[i] * (x.col(touch.pair.nodes[i]) - before_.col(touch.pair.nodes[i]));
  return touch.tangents.transpose() * moved;
}

double ContactFriction::value(const Matrix3Xd& x) const {
  double sum = 0;
  for (const Touch& touch : contacts_) sum += touch.force * CreepLaw(slideOf(touch, x).norm(), creep_).value;
  return sum;
}

void ContactFriction::addGradient(const Matrix3Xd& x, Matrix3Xd& gradient) const {
  for (const Touch& touch : contacts_) {
    const Vector2d slide = slideOf(touch, x);
    const Vector3d force = touch.force * CreepLaw(slide.norm(), creep_).slopeOverSlide * (touch.tangents * slide);
    for (int i = 0; i < geometry::cornerCount(touch.pair.kind); ++i)
      if (touch.pair.nodes[i] < deformableCount_) gradient.col(touch.pair.nodes[i]) += touch.weights[i] * force;
  }
}

void ContactFriction::addHessian(const Matrix3Xd& x, std::vector<ContactBlock>& blocks) const {
  for (const Touch& touch : contacts_) {
    const Vector2d slide = slideOf(touch, x);
    const double length = slide.norm();
    const CreepLaw law(length, creep_);
    Matrix2d second = law.slopeOverSlide * Matrix2d::Identity();
    if (length > 0) second += (law.curvature - law.slopeOverSlide) / (length * length) * slide * slide.transpose();
    const Matrix3d inSpace = touch.force * touch.tangents * second * touch.tangents.transpose();
    for (int i = 0; i < geometry::cornerCount(touch.pair.kind); ++i)
      for (int j = 0; j < geometry::cornerCount(touch.pair.kind); ++j) {
        const int row = touch.pair.nodes[i], column = touch.pair.nodes[j];
        const double share = touch.weights[i] * touch.weights[j];
        if (row < column || row >= deformableCount_ || share == 0) continue;
        blocks.push_back({row, column, share * inSpace});
      }
  }
}

std::vector<std::array<int, 2>> ContactFriction::coupledNodes() const {
  std::vector<std::array<int, 2>> couples;
  for (const Touch& touch : contacts_)
    for (int i = 0; i < geometry::cornerCount(touch.pair.kind); ++i)
      for (int j = 0; j < i; ++j)
        if (std::max(touch.pair.nodes[i], touch.pair.nodes[j]) < deformableCount_)
          couples.push_back({touch.pair.nodes[i], touch.pair.nodes[j]});
  return couples;
}

double ContactFriction::dissipated(const Matrix3Xd& x) const {
  double sum = 0;
  for (const Touch& touch : contacts_) {
    const double slide = slideOf(touch, x).norm();
    sum += touch.force * CreepLaw(slide, creep_).slopeOverSlide * slide * slide;
  }
  return sum;
}

double ContactFriction::largestForce() const {
  double sum = 0;
  for (const Touch& touch : contacts_) sum += touch.force;
  return sum;
}

double ContactFriction::slidingShare(const Matrix3Xd& x) const {
  double sliding = 0;
  for (const Touch& touch : contacts_)
    if (slideOf(touch, x).norm() > creep_) sliding += touch.force;
  return sliding > 0 ? sliding / largestForce() : 0;
}

}  // namespace pliant::mechanics
