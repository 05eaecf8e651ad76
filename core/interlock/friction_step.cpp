#include "core/interlock/friction_step.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/interlock/contact_motion.hpp"
#include "core/mechanics/creep_law.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using mechanics::CreepLaw;

/// Contacts that push less than this, over the strongest, have no friction worth computing.
constexpr double leastShare = 1e-7;

/// From the left: R = ΔR R_before.
Matrix3d turnBetween(const Matrix3d& before, const Matrix3d& now) { return now * before.transpose(); }

}  // namespace

FrictionStep::FrictionStep(const CellContact& contact, const CellState& before, const CellState& touching,
                           const std::vector<CellContactForce>& contacts, const Options& options)
    : contact_(contact), before_(before), options_(options) {
  double strongest = 0;
  for (const CellContactForce& each : contacts) strongest = std::max(strongest, each.force);
  for (const CellContactForce& each : contacts) {
    if (!(each.force > leastShare * strongest) || options.coefficient == 0) continue;
    const auto& [a, b, shift, partA, partB] = each.pair;
    const Vector3d armA = each.place - touching.positions.col(a);
    // The same place as seen from B, which stands at x_A - offset.
    const Vector3d armB = armA + contact.offsetOf(touching, a, b, shift);
    Contact made{
        each.pair, touching.rotations[a].transpose() * armA, touching.rotations[b].transpose() * armB, Vector3d::Zero(),
        {},        options.coefficient * each.force};
    made.tangents.col(0) = each.normal.unitOrthogonal();
    made.tangents.col(1) = each.normal.cross(made.tangents.col(0));
    made.before = betweenPlaces(made, before);
    contacts_.push_back(made);
  }
}

Vector3d FrictionStep::betweenPlaces(const Contact& contact, const CellState& state) const {
  const auto& [a, b, shift, partA, partB] = contact.pair;
  return contact_.offsetOf(state, a, b, shift) + state.rotations[a] * contact.armA - state.rotations[b] * contact.armB;
}

Vector2d FrictionStep::slideOf(const Contact& contact, const CellState& state) const {
  return contact.tangents.transpose() * (betweenPlaces(contact, state) - contact.before);
}

double FrictionStep::energy(const CellState& state) const {
  double sum = 0;
  for (const Contact& contact : contacts_)
    sum += contact.force * CreepLaw(slideOf(contact, state).norm(), options_.creep).value;
  double squares = 0;
  for (int i = 0; i < static_cast<int>(state.rotations.size()); ++i) {
    const double reach = contact_.partsOf(i).reach();
    squares += (state.positions.col(i) - before_.positions.col(i)).squaredNorm() +
               reach * reach * (3 - turnBetween(before_.rotations[i], state.rotations[i]).trace());
  }
  return sum + 0.5 * options_.drag * squares +
         0.5 * strainDragStiffness() * (state.strain - before_.strain).squaredNorm();
}

void FrictionStep::visitContacts(const CellState& state, const CellContact::Visitor& visit) const {
  ContactTerms terms;
  for (const Contact& contact : contacts_) {
    const auto& [a, b, shift, partA, partB] = contact.pair;
    const Vector2d slide = slideOf(contact, state);
    const double length = slide.norm();
    const CreepLaw law(length, options_.creep);
    const Vector3d armA = state.rotations[a] * contact.armA, armB = state.rotations[b] * contact.armB;
    const ContactJacobian jacobian =
        contactJacobian(armA, armB, contact_.cell().lattice * Vector2d(shift[0], shift[1]));
    const Vector3d slope = contact.force * law.slopeOverSlide * (contact.tangents * slide);
    Matrix2d second = law.slopeOverSlide * Matrix2d::Identity();
    if (length > 0) second += (law.curvature - law.slopeOverSlide) / (length * length) * slide * slide.transpose();
    terms.value = contact.force * law.value;
    terms.gradient = jacobian.transpose() * slope;
    terms.hessian =
        jacobian.transpose() * (contact.force * contact.tangents * second * contact.tangents.transpose()) * jacobian;
    terms.hessian.block<3, 3>(3, 3) += rotationTerm(slope, armA);
    terms.hessian.block<3, 3>(9, 9) -= rotationTerm(slope, armB);
    visit(contact.pair, terms);
  }
}

void FrictionStep::elementDrag(const CellState& state, int element, Vector6& gradient, Matrix6& hessian) const {
  const double reach = contact_.partsOf(element).reach(), turning = 0.5 * options_.drag * reach * reach;
  const Matrix3d turn = turnBetween(before_.rotations[element], state.rotations[element]);
  gradient.head<3>() = options_.drag * (state.positions.col(element) - before_.positions.col(element));
  gradient.tail<3>() = turning * Vector3d(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  hessian.setZero();
  hessian.diagonal().head<3>().setConstant(options_.drag);
  hessian.bottomRightCorner<3, 3>() = turning * (turn.trace() * Matrix3d::Identity() - 0.5 * (turn + turn.transpose()));
}

Vector3d FrictionStep::strainDrag(const CellState& state) const {
  return strainDragStiffness() * (state.strain - before_.strain);
}

void FrictionStep::addDerivatives(const CellState& state, Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) const {
  const Eigen::Index strain = gradient.size() - 3;
  visitContacts(state, [&](const PartPair& pair, const ContactTerms& terms) {
    constexpr std::array<int, 3> from = {0, 6, 12}, length = {6, 6, 3};
    const std::array<Eigen::Index, 3> to = {6 * pair.a, 6 * pair.b, strain};
    for (int i = 0; i < 3; ++i) {
      gradient.segment(to[i], length[i]) += terms.gradient.segment(from[i], length[i]);
      for (int j = 0; j < 3; ++j)
        hessian.block(to[i], to[j], length[i], length[j]) +=
            terms.hessian.block(from[i], from[j], length[i], length[j]);
    }
  });
  Vector6 own;
  Matrix6 second;
  for (int i = 0; i < static_cast<int>(state.rotations.size()); ++i) {
    elementDrag(state, i, own, second);
    gradient.segment<6>(6 * Eigen::Index{i}) += own;
    hessian.block<6, 6>(6 * Eigen::Index{i}, 6 * Eigen::Index{i}) += second;
  }
  gradient.tail<3>() += strainDrag(state);
  hessian.diagonal().tail<3>().array() += strainDragStiffness();
}

}  // namespace pliant::interlock
