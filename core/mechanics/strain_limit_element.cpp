#include "core/mechanics/strain_limit_element.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pliant::mechanics {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Hinge i of a triangle with its neighbours: the edge, the corner opposite it, and the neighbour's.
std::array<int, 4> hingeCorners(int i) { return {(i + 1) % 3, (i + 2) % 3, i, 3 + i}; }

struct HingeAngle {
  double angle;
  std::array<double, 12> gradient;
};

std::array<double, 12> hingePlaces(const std::array<double, 18>& x, int i) {
  std::array<double, 12> at;
  const std::array<int, 4> corners = hingeCorners(i);
  for (int k = 0; k < 4; ++k)
    for (int axis = 0; axis < 3; ++axis) at[3 * k + axis] = x[3 * corners[k] + axis];
  return at;
}

HingeAngle hingeAngle(const std::array<double, 12>& at) {
  HingeElement::RestAngleDerivative<double> derivative;
  HingeElement{0.5, 0}.evaluateAgainst<double>(0, at, nullptr, nullptr, &derivative);  // of ½ θ²
  return {derivative.moment, derivative.mixed};
}

int placeInElement(int hinge, int coordinate) { return 3 * hingeCorners(hinge)[coordinate / 3] + coordinate % 3; }

}  // namespace

StrainFunction limitPotential(const AdmissibleStrainSet& set, const StrainLimitFunction& function,
                              const Vector3d& strain, bool withDerivatives) {
  const double c = function.coefficient;
  StrainFunction result;
  if (function.kind == StrainLimitFunction::Kind::barrier) {
    StrainFunction g = set.gauge(strain, withDerivatives);
    const double shrunk = 1 / (1 - function.margin);
    g.value *= shrunk;
    g.gradient *= shrunk;
    g.hessian *= shrunk;
    const double room = 1 - g.value * g.value;
    if (!(room > 0)) {
      result.value = std::numeric_limits<double>::infinity();
      return result;
    }
    const double first = 2 * c * g.value / room;
    const Matrix3d outer = g.gradient * g.gradient.transpose();
    result.value = -c * std::log(room);
    if (!withDerivatives) return result;
    result.gradient = first * g.gradient;
    result.hessian = first * g.hessian + (2 * c / room + first * first / c) * outer;
  } else {
    const StrainFunction d = set.distance(strain);
    if (!(d.value > 0)) return result;
    result.value = c * d.value * d.value * d.value;
    result.gradient = 3 * c * d.value * d.value * d.gradient;
    result.hessian = 6 * c * d.value * d.gradient * d.gradient.transpose() + 3 * c * d.value * d.value * d.hessian;
  }
  return result;
}

namespace {

/// Edges from corner 0 and the derivatives of their metric by the coordinates, 3 x 9.
struct EdgeMetric {
  Vector3d e1, e2;
  Vector3d metric;
  Eigen::Matrix<double, 3, 9> derivative;

  explicit EdgeMetric(const std::array<double, 9>& x) {
    const Eigen::Map<const Matrix3d> corners(x.data());
    e1 = corners.col(1) - corners.col(0);
    e2 = corners.col(2) - corners.col(0);
    metric = {e1.squaredNorm(), e2.squaredNorm(), e1.dot(e2)};
    derivative.setZero();
    derivative.block<1, 3>(0, 3) = 2 * e1.transpose();
    derivative.block<1, 3>(1, 6) = 2 * e2.transpose();
    derivative.block<1, 3>(2, 3) = e2.transpose();
    derivative.block<1, 3>(2, 6) = e1.transpose();
    derivative.leftCols<3>() = -derivative.middleCols<3>(3) - derivative.rightCols<3>();
  }
};

template <int count>
void pack(const Eigen::Matrix<double, count, count>& full, std::array<double, packedSize(count)>& packed) {
  for (int i = 0; i < count; ++i)
    for (int j = 0; j <= i; ++j) packed[packedIndex(i, j)] = full(i, j);
}

}  // namespace

Vector3d StretchLimitElement::strain(const std::array<double, 9>& x) const {
  return strainOfMetric * (EdgeMetric(x).metric - restMetric);
}

double StretchLimitElement::evaluateOne(const std::array<double, 9>& x, std::array<double, 9>* gradient,
                                        std::array<double, packedSize(9)>* hessian, bool convex) const {
  const EdgeMetric at(x);
  const StrainFunction potential =
      limitPotential(*set, function, strainOfMetric * (at.metric - restMetric), gradient || hessian);
  if (!gradient && !hessian) return area * potential.value;
  const Vector3d stress = area * strainOfMetric.transpose() * potential.gradient;
  if (gradient) Eigen::Map<Eigen::Matrix<double, 9, 1>>(gradient->data()) = at.derivative.transpose() * stress;
  if (hessian) {
    const Eigen::Matrix<double, 3, 9> strainDerivative = strainOfMetric * at.derivative;
    const Matrix3d second = convex ? positivePart<3>(potential.hessian) : potential.hessian;
    Eigen::Matrix<double, 9, 9> full = area * strainDerivative.transpose() * second * strainDerivative;
    // ∇²a: 2 I of e₁·e₁ on the first edge, and so on; corner 0 moves both edges backwards.
    Eigen::Matrix2d edgeStress;
    edgeStress << 2 * stress[0], stress[2], stress[2], 2 * stress[1];
    if (convex) {
      const Eigen::Matrix2d inverse = restEdges.inverse();
      edgeStress = inverse * positivePart<2>(restEdges * edgeStress * restEdges.transpose()) * inverse.transpose();
    }
    const double s1 = edgeStress(0, 0), s2 = edgeStress(1, 1), s3 = edgeStress(0, 1);
    const double blocks[3][3] = {{s1 + s2 + 2 * s3, -s1 - s3, -s2 - s3}, {-s1 - s3, s1, s3}, {-s2 - s3, s3, s2}};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) full.block<3, 3>(3 * a, 3 * b).diagonal().array() += blocks[a][b];
    pack<9>(full, *hessian);
  }
  return area * potential.value;
}

Vector3d CurvatureLimitElement::curvature(const std::array<double, 18>& x) const {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    if (hasNeighbour[i]) sum += hingeAngle(hingePlaces(x, i)).angle * curvatureOfAngles.col(i);
  return sum;
}

double CurvatureLimitElement::evaluateOne(const std::array<double, 18>& x, std::array<double, 18>* gradient,
                                          std::array<double, packedSize(18)>* hessian, bool convex) const {
  std::array<std::array<double, 12>, 3> places;
  std::array<HingeAngle, 3> hinges;
  Vector3d curvature = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (!hasNeighbour[i]) continue;
    places[i] = hingePlaces(x, i);
    hinges[i] = hingeAngle(places[i]);
    curvature += hinges[i].angle * curvatureOfAngles.col(i);
  }
  const StrainFunction potential = limitPotential(*set, function, curvature, gradient || hessian);
  if (!gradient && !hessian) return area * potential.value;
  const Vector3d moments = area * curvatureOfAngles.transpose() * potential.gradient;

  Eigen::Matrix<double, 3, 18> angleDerivative = Eigen::Matrix<double, 3, 18>::Zero();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; hasNeighbour[i] && k < 12; ++k) angleDerivative(i, placeInElement(i, k)) = hinges[i].gradient[k];
  if (gradient) Eigen::Map<Eigen::Matrix<double, 18, 1>>(gradient->data()) = angleDerivative.transpose() * moments;
  if (hessian) {
    Matrix3d second = area * curvatureOfAngles.transpose() *
                      (convex ? positivePart<3>(potential.hessian) : potential.hessian) * curvatureOfAngles;
    // A hinge of stiffness ½ |m| whose rest angle is ±1 away has the Hessian |m| ∇θ∇θᵀ + m ∇²θ.
    if (!convex) second.diagonal() -= moments.cwiseAbs();
    Eigen::Matrix<double, 18, 18> full = angleDerivative.transpose() * second * angleDerivative;
    for (int i = 0; i < 3; ++i) {
      if (convex || !hasNeighbour[i] || moments[i] == 0) continue;
      std::array<double, packedSize(12)> hinge;
      HingeElement{0.5 * std::abs(moments[i]), 0}.evaluateAgainst<double>(
          hinges[i].angle - std::copysign(1.0, moments[i]), places[i], nullptr, &hinge, nullptr);
      for (int k = 0; k < 12; ++k)
        for (int l = 0; l < 12; ++l)
          full(placeInElement(i, k), placeInElement(i, l)) += hinge[packedIndex(std::max(k, l), std::min(k, l))];
    }
    pack<18>(full, *hessian);
  }
  return area * potential.value;
}

}  // namespace pliant::mechanics
