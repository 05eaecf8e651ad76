#include "core/interlock/cell_contact.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "core/interlock/contact_terms.hpp"
#include "core/interlock/element_pose.hpp"

namespace pliant::interlock {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;

CellState restState(const UnitCell& cell) {
  CellState state;
  state.positions.resize(3, static_cast<Eigen::Index>(cell.elements.size()));
  for (std::size_t i = 0; i < cell.elements.size(); ++i) {
    state.positions.col(static_cast<Eigen::Index>(i)) = cell.elements[i].position;
    state.rotations.push_back(cell.elements[i].rotation);
  }
  return state;
}

const std::array<Matrix2d, 3>& stretchBasis() {
  static const std::array<Matrix2d, 3> basis = {
      Matrix2d::Identity(), (Matrix2d() << 1, 0, 0, -1).finished(), (Matrix2d() << 0, 1, 1, 0).finished()};
  return basis;
}

Matrix2d stretchOf(const Vector3d& strain) {
  Matrix2d stretch = Matrix2d::Identity();
  for (int k = 0; k < 3; ++k) stretch += strain[k] * stretchBasis()[k];
  return stretch;
}

CellState moved(const CellState& state, const Eigen::VectorXd& velocity, double step) {
  CellState next = state;
  for (std::size_t i = 0; i < state.rotations.size(); ++i) {
    const auto own = velocity.segment<6>(6 * static_cast<Eigen::Index>(i));
    next.positions.col(static_cast<Eigen::Index>(i)) += step * own.head<3>();
    const Vector3d turn = step * own.tail<3>();
    const double angle = turn.norm();
    if (angle == 0) continue;
    // Through a quaternion, so that rounding never makes the matrix anything but a rotation.
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(angle, turn / angle));
    next.rotations[i] = (turned * Eigen::Quaterniond(state.rotations[i])).normalized().toRotationMatrix();
  }
  next.strain += step * velocity.tail<3>();
  return next;
}

namespace {

/// An arc cut into several, or anything else as it is.
struct SplitPart {
  std::vector<Part> parts;
  std::vector<PlacedPart> placed;  ///< pointing to parts

  void split(const PlacedPart& whole, int count) {
    if (whole.part->kind != PartKind::arc) {
      placed.assign(1, whole);
      return;
    }
    parts.assign(count, *whole.part);
    placed.assign(count, whole);
    const double begin = whole.part->begin, step = (whole.part->end - begin) / count;
    for (int i = 0; i < count; ++i) {
      if (i > 0) parts[i].begin = parts[i - 1].end;
      if (i + 1 < count) parts[i].end = begin + (i + 1) * step;
      // Between its ends an arc strays from the chord by at most h²/8 |c''|.
      parts[i].sagitta = std::min(whole.part->sagitta, step * step / 8 * whole.part->secondBound);
      placed[i].part = &parts[i];
      if (i > 0) placed[i].corners.col(0) = placed[i - 1].corners.col(1);
      if (i + 1 < count) placed[i].corners.col(1) = whole.curve->placeAt(parts[i].end);
      parts[i].chord = (placed[i].corners.col(1) - placed[i].corners.col(0)).norm();
    }
  }
};

}  // namespace

struct CellContact::Pose {
  std::vector<ClosedCurve> curves;
  Matrix3Xd corners;
};

CellContact::CellContact(const UnitCell& cell, double arcTurn) : cell_(cell) {
  for (const ElementShape& shape : cell.shapes) parts_.emplace_back(shape, arcTurn);
}

bool CellContact::hasThinPieces() const {
  const double length = cell_.smallestRadius();
  for (const ElementShape& shape : cell_.shapes)
    for (const DilatedPiece& piece : shape.pieces)
      if (piece.radius < length) return true;
  return false;
}

Vector3d CellContact::offsetOf(const CellState& state, int a, int b, const std::array<int, 2>& shift) const {
  Vector3d offset = state.positions.col(a) - state.positions.col(b);
  offset.head<2>() -= stretchOf(state.strain) * (cell_.lattice * Vector2d(shift[0], shift[1]));
  return offset;
}

std::vector<CellContact::ImagePair> CellContact::nearElements(const CellState& state, double reach) const {
  std::vector<ImagePair> pairs;
  if (!cell_.isPeriodic()) {
    for (int b = 1; b < static_cast<int>(cell_.elements.size()); ++b)
      for (int a = 0; a < b; ++a) {
        const double farthest = partsOf(a).reach() + partsOf(b).reach() + reach;
        if ((state.positions.col(a) - state.positions.col(b)).squaredNorm() < farthest * farthest)
          pairs.push_back({a, b, {0, 0}});
      }
    return pairs;
  }
  const Matrix2d inverse = (stretchOf(state.strain) * cell_.lattice).inverse();
  const int count = static_cast<int>(cell_.elements.size());
  for (int a = 0; a < count; ++a)
    for (int b = a; b < count; ++b) {
      const double farthest = partsOf(a).reach() + partsOf(b).reach() + reach;
      const Vector3d between = state.positions.col(a) - state.positions.col(b);
      const Vector2d middle = inverse * between.head<2>();
      const Vector2d extent = farthest * inverse.rowwise().norm();
      for (int i = static_cast<int>(std::ceil(middle[0] - extent[0])); i <= middle[0] + extent[0]; ++i)
        for (int j = static_cast<int>(std::ceil(middle[1] - extent[1])); j <= middle[1] + extent[1]; ++j) {
          if (a == b && (i < 0 || (i == 0 && j <= 0))) continue;  // found from the other side
          if (offsetOf(state, a, b, {i, j}).norm() < farthest) pairs.push_back({a, b, {i, j}});
        }
    }
  return pairs;
}

std::vector<PartPair> CellContact::nearParts(const CellState& state, double reach) const {
  std::vector<PartPair> pairs;
  std::vector<std::array<int, 2>> near;
  std::vector<Matrix3Xd> centres(cell_.elements.size());  // of all balls, turned
  for (std::size_t i = 0; i < centres.size(); ++i)
    centres[i] = state.rotations[i] * partsOf(static_cast<int>(i)).centres();
  for (const auto& [a, b, shift] : nearElements(state, reach)) {
    const ElementParts &first = partsOf(a), &second = partsOf(b);
    const Vector3d offset = offsetOf(state, a, b, shift);
    near.clear();
    appendNearParts(first, centres[a], second, centres[b], offset, reach, near);
    for (const auto& [partA, partB] : near) pairs.push_back({a, b, shift, partA, partB});
  }
  return pairs;
}

std::vector<CellContact::Pose> CellContact::posesOf(const CellState& state) const {
  std::vector<Pose> poses(cell_.elements.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const ElementParts& parts = partsOf(static_cast<int>(i));
    for (const ClosedCurve& curve : parts.curves()) poses[i].curves.push_back(curve.rotated(state.rotations[i]));
    poses[i].corners = state.rotations[i] * parts.corners();
  }
  return poses;
}

PlacedPart CellContact::placed(const std::vector<Pose>& poses, int element, int part) const {
  const Part& own = partsOf(element).parts()[part];
  PlacedPart result{&own, own.kind == PartKind::arc ? &poses[element].curves[own.curve] : nullptr, {}};
  for (int i = 0; i < 3; ++i) result.corners.col(i) = poses[element].corners.col(own.corners[i]);
  return result;
}

double CellContact::visitContacts(const CellState& state, const std::vector<PartPair>& pairs, const Barrier& barrier,
                                  bool wantGradient, bool wantHessian, const Visitor& visit) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!state.positions.allFinite() || !state.strain.allFinite()) return infinity;
  const std::vector<Pose> poses = posesOf(state);
  double energy = 0;
  SplitPart partsA, partsB;
  Vector3d offset;
  ContactTerms terms;
  // False if the parts overlap.
  const auto add = [&](const PartPair& pair, const PlacedPart& a, const PlacedPart& b) {
    const Vector2d translation = cell_.lattice * Vector2d(pair.shift[0], pair.shift[1]);
    if (!terms.compute(a, b, offset, translation, barrier, wantGradient, wantHessian)) return true;
    if (!(terms.gap > 0)) return false;
    energy += terms.value;
    visit(pair, terms);
    return true;
  };
  const PartPair* last = nullptr;
  for (const PartPair& pair : pairs) {
    const PlacedPart a = placed(poses, pair.a, pair.partA), b = placed(poses, pair.b, pair.partB);
    if (!last || last->a != pair.a || last->b != pair.b || last->shift != pair.shift)
      offset = offsetOf(state, pair.a, pair.b, pair.shift);
    last = &pair;
    if (areApart(a, b, offset, a.part->radius + b.part->radius + barrier.range)) continue;
    if (barrier.split == 1) {
      if (!add(pair, a, b)) return infinity;
      continue;
    }
    partsA.split(a, barrier.split);
    partsB.split(b, barrier.split);
    for (const PlacedPart& subA : partsA.placed)
      for (const PlacedPart& subB : partsB.placed)
        if (!areApart(subA, subB, offset, a.part->radius + b.part->radius + barrier.range) && !add(pair, subA, subB))
          return infinity;
  }
  return energy;
}

double CellContact::energy(const CellState& state, const std::vector<PartPair>& pairs, const Barrier& barrier,
                           Eigen::VectorXd* gradient, Eigen::MatrixXd* hessian, double* smallestGap,
                           std::vector<CellContactForce>* forces) const {
  const int size = coordinateCount();
  if (gradient) gradient->setZero(size);
  if (hessian) hessian->setZero(size, size);
  if (forces) forces->clear();
  double gap = barrier.range;
  // Local coordinates: six of a, six of b, three of the strain.
  constexpr std::array<int, 3> from = {0, 6, 12}, length = {6, 6, 3};
  const double energy = visitContacts(
      state, pairs, barrier, gradient != nullptr, hessian != nullptr,
      [&](const PartPair& pair, const ContactTerms& terms) {
        gap = std::min(gap, terms.gap);
        if (forces)
          forces->push_back({pair, terms.gap, terms.force, terms.place + state.positions.col(pair.a), terms.normal});
        const std::array<int, 3> to = {6 * pair.a, 6 * pair.b, size - 3};
        for (int i = 0; i < 3; ++i) {
          if (gradient) gradient->segment(to[i], length[i]) += terms.gradient.segment(from[i], length[i]);
          if (!hessian) continue;
          for (int j = 0; j < 3; ++j)
            hessian->block(to[i], to[j], length[i], length[j]) +=
                terms.hessian.block(from[i], from[j], length[i], length[j]);
        }
      });
  if (smallestGap) *smallestGap = gap;
  return energy;
}

double CellContact::smallestGap(const CellState& state, double reach, PartPair* where) const {
  const std::vector<Pose> poses = posesOf(state);
  double smallest = reach;
  for (const PartPair& pair : nearParts(state, reach)) {
    const PlacedPart a = placed(poses, pair.a, pair.partA), b = placed(poses, pair.b, pair.partB);
    const Vector3d offset = offsetOf(state, pair.a, pair.b, pair.shift);
    if (areApart(a, b, offset, a.part->radius + b.part->radius + smallest)) continue;
    const double gap = gapBetween(a, b, offset);
    if (gap >= smallest) continue;
    smallest = gap;
    if (where) *where = pair;
  }
  return smallest;
}

}  // namespace pliant::interlock
