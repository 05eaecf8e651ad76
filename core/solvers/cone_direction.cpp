#include <algorithm>

#include "core/solvers/cone_elements.hpp"

namespace pliant::solvers {

namespace {

/// The inverse of the longest step α with p + α dp positive semidefinite, at least 0; p is positive definite. It is
/// minus the smallest eigenvalue of p^{-½} dp p^{-½}.
Packet inverseStep(const SymmetricPacket& p, const SymmetricPacket& dp) {
  const Packet inverseDeterminant = 1.0 / p.determinant();
  const Packet half = 0.5 * dot(p.adjugate(), dp) * inverseDeterminant;
  const Packet product = dp.determinant() * inverseDeterminant;
  return sqrt(maximum(half * half - product, 0.0)) - half;
}

}  // namespace

double ConeElements::direct(const Positions& dx) {
  Packet longest = 0.0;  // inverse of the step
  for (Group& group : groups_) {
    group.df = mapOf(group, dx);
    const SymmetricPacket e = symmetricPart(group.f, group.df);
    const Bounds& bounds = bounds_[group.bounds];
    for (std::size_t k = 0; k < bounds.scalings.size(); ++k) {
      Ellipse& cone = ellipses_[group.firstEllipse + k];
      cone.ds = -(cone.r + cone.h + congruence(bounds.scalings[k], e));
      cone.dl = cone.y - cone.l - congruence(cone.u, cone.ds);
      longest = maximum(longest, maximum(inverseStep(cone.s, cone.ds), inverseStep(cone.l, cone.dl)));
    }
    for (std::size_t k = 0; k < bounds.directions.size(); ++k) {
      Direction& cone = directions_[group.firstDirection + k];
      cone.ds = -(cone.r + cone.h + along(e, bounds.directions[k]));
      cone.dl = cone.y - cone.l - cone.l / cone.s * cone.ds;
      longest = maximum(longest, maximum(-cone.ds / cone.s, -cone.dl / cone.l));
    }
  }
  return 1 / std::max(largestOf(longest), 1e-300);
}

double ConeElements::complementarityAfter(double step) const {
  Packet sum = 0.0;
  for (const Group& group : groups_) {
    const Bounds& bounds = bounds_[group.bounds];
    Packet own = 0.0;
    for (std::size_t k = 0; k < bounds.scalings.size(); ++k) {
      const Ellipse& cone = ellipses_[group.firstEllipse + k];
      own += dot(cone.l + step * cone.dl, cone.s + step * cone.ds);
    }
    for (std::size_t k = 0; k < bounds.directions.size(); ++k) {
      const Direction& cone = directions_[group.firstDirection + k];
      own += (cone.l + step * cone.dl) * (cone.s + step * cone.ds);
    }
    sum += group.mask * own;
  }
  return sumOf(sum);
}

void ConeElements::clearCorrection() {
  for (Ellipse& cone : ellipses_) cone.h = cone.y = {0.0, 0.0, 0.0};
  for (Direction& cone : directions_) cone.h = cone.y = 0.0;
}

void ConeElements::correct(double target, double weight, Positions& forces) {
  for (Group& group : groups_) {
    const SymmetricPacket change = 0.5 * weight * group.df.metric();
    const Bounds& bounds = bounds_[group.bounds];
    SymmetricPacket own{0.0, 0.0, 0.0}, product = own;
    for (std::size_t k = 0; k < bounds.scalings.size(); ++k) {
      Ellipse& cone = ellipses_[group.firstEllipse + k];
      const SymmetricPacket& t = bounds.scalings[k];
      cone.h = congruence(t, change);
      const SymmetricPacket scaledProduct =
          weight * symmetricProduct(congruence(cone.inverseG, cone.ds), congruence(cone.g, cone.dl));
      const SymmetricPacket right{target - scaledProduct.a, target - scaledProduct.b, -scaledProduct.c};
      cone.y = congruence(cone.inverseG, solveSymmetricProduct(cone.v, right));
      own += congruence(t, congruence(cone.u, cone.r + cone.h) + cone.y);
      product += congruence(t, cone.dl);
    }
    for (std::size_t k = 0; k < bounds.directions.size(); ++k) {
      Direction& cone = directions_[group.firstDirection + k];
      const std::array<double, 2>& v = bounds.directions[k];
      cone.h = along(change, v);
      cone.y = (target - weight * cone.ds * cone.dl) / cone.s;
      own += scaledOuter(cone.l / cone.s * (cone.r + cone.h) + cone.y, v);
      product += scaledOuter(cone.dl, v);
    }
    Packet nodeForces[3][3];
    addForce(group, group.f, own, nodeForces);
    addForce(group, group.df, weight * product, nodeForces);
    scatter(group, nodeForces, forces);
  }
}

void ConeElements::centralise(double target, double step, Positions& forces) {
  constexpr double farthest = 10;
  // Products that are much too large are not pulled down all of the way at once.
  const auto change = [target](const Packet& product) {
    return maximum(minimum(maximum(product, target / farthest), farthest * target) - product, -farthest * target);
  };
  for (Group& group : groups_) {
    const Bounds& bounds = bounds_[group.bounds];
    SymmetricPacket own{0.0, 0.0, 0.0}, product = own;
    for (std::size_t k = 0; k < bounds.scalings.size(); ++k) {
      Ellipse& cone = ellipses_[group.firstEllipse + k];
      const SymmetricPacket& t = bounds.scalings[k];
      const SymmetricPacket reached = symmetricProduct(
          congruence(cone.inverseG, cone.s + step * cone.ds), congruence(cone.g, cone.l + step * cone.dl));
      cone.y += congruence(cone.inverseG, solveSymmetricProduct(cone.v, mapEigenvalues(reached, change)));
      own += congruence(t, congruence(cone.u, cone.r + cone.h) + cone.y);
      product += congruence(t, cone.dl);
    }
    for (std::size_t k = 0; k < bounds.directions.size(); ++k) {
      Direction& cone = directions_[group.firstDirection + k];
      const std::array<double, 2>& v = bounds.directions[k];
      cone.y += change((cone.s + step * cone.ds) * (cone.l + step * cone.dl)) / cone.s;
      own += scaledOuter(cone.l / cone.s * (cone.r + cone.h) + cone.y, v);
      product += scaledOuter(cone.dl, v);
    }
    Packet nodeForces[3][3];
    addForce(group, group.f, own, nodeForces);
    addForce(group, group.df, product, nodeForces);
    scatter(group, nodeForces, forces);
  }
}

void ConeElements::keepDirection() {
  for (Group& group : groups_) group.keptDf = group.df;
  for (Ellipse& cone : ellipses_) {
    cone.keptDs = cone.ds;
    cone.keptDl = cone.dl;
  }
  for (Direction& cone : directions_) {
    cone.keptDs = cone.ds;
    cone.keptDl = cone.dl;
  }
}

void ConeElements::restoreDirection() {
  for (Group& group : groups_) group.df = group.keptDf;
  for (Ellipse& cone : ellipses_) {
    cone.ds = cone.keptDs;
    cone.dl = cone.keptDl;
  }
  for (Direction& cone : directions_) {
    cone.ds = cone.keptDs;
    cone.dl = cone.keptDl;
  }
}

void ConeElements::advance(double step) {
  for (Ellipse& cone : ellipses_) {
    cone.s += step * cone.ds;
    cone.l += step * cone.dl;
  }
  for (Direction& cone : directions_) {
    cone.s += step * cone.ds;
    cone.l += step * cone.dl;
  }
}

}  // namespace pliant::solvers
