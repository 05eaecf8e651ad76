#include "core/mechanics/element_stress.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/mechanics/hinge_element.hpp"

namespace pliant::mechanics {

double ElementStress::momentOf(const Hinge& hinge, const Vector& x, std::array<double, 12>* gradient) {
  std::array<double, 12> at;
  for (std::size_t i = 0; i < 12; ++i) at[i] = x[3 * hinge.nodes[i / 3] + static_cast<int>(i % 3)];
  HingeElement::RestAngleDerivative<double> derivative;
  HingeElement{hinge.stiffness, hinge.restAngle}.evaluateAgainst<double>(
      hinge.restAngle, at, nullptr, nullptr, &derivative);
  if (gradient) *gradient = derivative.mixed;
  return derivative.moment;
}

template <int D>
Eigen::Matrix<double, 3, D> ElementStress::deformation(const Body<D>& body, const Vector& x) const {
  Eigen::Matrix<double, 3, D> edges = Eigen::Matrix<double, 3, D>::Zero();
  for (int k = 0; k < D; ++k)
    for (int axis = 0; axis < dimension_; ++axis)
      edges(axis, k) =
          x[body.nodes[static_cast<std::size_t>(k) + 1] * dimension_ + axis] - x[body.nodes[0] * dimension_ + axis];
  return edges * body.inverse;
}

template <int D>
ElementStress::Square<D> ElementStress::bendingStress(const Body<D>& body, const Vector& x) const {
  Square<D> stress = Square<D>::Zero();
  if constexpr (D == 2)
    for (const Side& side : body.sides)
      stress += momentOf(hinges_[static_cast<std::size_t>(side.hinge)], x, nullptr) * side.stress;
  return stress;
}

template <int D>
double ElementStress::measured(const Body<D>& body, const Square<D>& metric, const Square<D>& added,
                               Square<D>* byMetric, Square<D>* byAdded) const {
  const Square<D> identity = Square<D>::Identity();
  if (measure_ == ElementMeasure::principalStrain) {
    const auto strainOf = [&](const Square<D>& stress) -> Square<D> {
      return (stress - body.lambda / (D * body.lambda + body.twoMu) * stress.trace() * identity) / body.twoMu;
    };
    Eigen::SelfAdjointEigenSolver<Square<D>> squares(metric + 2 * strainOf(added));
    const double stretch = std::sqrt(std::max(0.0, squares.eigenvalues()[D - 1]));
    if (byMetric) {
      const Eigen::Matrix<double, D, 1> direction = squares.eigenvectors().col(D - 1);
      const Square<D> byStrain = direction * direction.transpose() / std::max(stretch, 1e-300);
      *byMetric = 0.5 * byStrain;
      *byAdded = strainOf(byStrain);
    }
    return stretch - 1;
  }
  const auto law = [&](const Square<D>& strain) -> Square<D> {
    return body.lambda * strain.trace() * identity + body.twoMu * strain;
  };
  const Square<D> strain = 0.5 * (metric - identity);
  const Square<D> stress = law(strain) + added, product = stress * metric;
  const double trace = product.trace();
  // No thinner than a hundredth: there the law in plane stress has long lost its sense.
  const double thinness = std::max(1e-4, 1 - 2 * body.thinning * strain.trace());
  const double squaredVolume = metric.determinant() * thinness;
  const double squared =
      std::max(0.0, 1.5 * (product * product).trace() - 0.5 * trace * trace) / std::max(squaredVolume, 1e-300);
  const double value = std::sqrt(squared);
  if (!byMetric) return value;
  byMetric->setZero();
  byAdded->setZero();
  if (!(value > 0)) return value;  // the tip of a cone
  const Square<D> byStress = (3 * metric * product - trace * metric) / squaredVolume;
  const Square<D> byVolume = metric.inverse() - body.thinning / thinness * identity;
  *byAdded = byStress / (2 * value);
  *byMetric = ((3 * product * stress - trace * stress) / squaredVolume + 0.5 * law(byStress) - squared * byVolume) /
              (2 * value);
  return value;
}

Vector ElementStress::values(const Vector& x) const {
  Vector result(count_);
  Eigen::Index place = 0;
  const auto tell = [&]<int D>(const Body<D>& body) {
    const Eigen::Matrix<double, 3, D> f = deformation(body, x);
    const Square<D> metric = f.transpose() * f, added = bendingStress(body, x);
    result[place++] = measured<D>(body, metric, added, nullptr, nullptr);
    if (body.placeCount() == 2) result[place++] = measured<D>(body, metric, -added, nullptr, nullptr);
  };
  for (const Body<2>& body : triangles_) tell(body);
  for (const Body<3>& body : tetrahedra_) tell(body);
  return result;
}

Vector ElementStress::byStiffness(const Vector& x, const Vector& weights) const {
  Vector result = Vector::Zero(count_);
  Eigen::Index place = 0;
  const auto tell = [&]<int D>(const Body<D>& body) {
    const Eigen::Matrix<double, 3, D> f = deformation(body, x);
    const Square<D> metric = f.transpose() * f, bending = bendingStress(body, x);
    for (int surface = 0; surface < body.placeCount(); ++surface, ++place) {
      if (weights[place] == 0) continue;
      const Square<D> added = surface == 0 ? bending : Square<D>(-bending);
      Square<D> byMetric, byAdded;
      const double value = measured<D>(body, metric, added, &byMetric, &byAdded);
      // The stress is of the first degree in that of the stretch and that of bending together; a strain by bending is
      // that of a given stress.
      const double ofAll = measure_ == ElementMeasure::vonMises ? value : 0;
      result[place] = weights[place] * (ofAll - byAdded.cwiseProduct(added).sum());
    }
  };
  for (const Body<2>& body : triangles_) tell(body);
  for (const Body<3>& body : tetrahedra_) tell(body);
  return result;
}

template <int D>
void ElementStress::addBodyGradient(const Body<D>& body, const Vector& x, const double* weights,
                                    Vector& gradient) const {
  const Eigen::Matrix<double, 3, D> f = deformation(body, x);
  const Square<D> metric = f.transpose() * f, bending = bendingStress(body, x);
  Square<D> byMetric = Square<D>::Zero(), byBending = Square<D>::Zero();
  for (int surface = 0; surface < body.placeCount(); ++surface) {
    const double sign = surface == 0 ? 1 : -1;
    Square<D> ofMetric, ofAdded;
    measured<D>(body, metric, sign * bending, &ofMetric, &ofAdded);
    byMetric += weights[surface] * ofMetric;
    byBending += weights[surface] * sign * ofAdded;
  }
  const Eigen::Matrix<double, 3, D> byEdges = f * (byMetric + byMetric.transpose()) * body.inverse.transpose();
  for (int k = 0; k < D; ++k)
    for (int axis = 0; axis < dimension_; ++axis) {
      gradient[body.nodes[static_cast<std::size_t>(k) + 1] * dimension_ + axis] += byEdges(axis, k);
      gradient[body.nodes[0] * dimension_ + axis] -= byEdges(axis, k);
    }
  if constexpr (D == 2)
    for (const Side& side : body.sides) {
      const Hinge& hinge = hinges_[static_cast<std::size_t>(side.hinge)];
      std::array<double, 12> byNodes;
      momentOf(hinge, x, &byNodes);
      const double share = byBending.cwiseProduct(side.stress).sum();
      for (std::size_t i = 0; i < 12; ++i)
        gradient[3 * hinge.nodes[i / 3] + static_cast<int>(i % 3)] += share * byNodes[i];
    }
}

void ElementStress::addGradient(const Vector& x, const Vector& weights, Vector& gradient) const {
  const double* next = weights.data();
  const auto add = [&](const auto& body) {
    if (std::any_of(next, next + body.placeCount(), [](double weight) { return weight != 0; }))
      addBodyGradient(body, x, next, gradient);
    next += body.placeCount();
  };
  for (const Body<2>& body : triangles_) add(body);
  for (const Body<3>& body : tetrahedra_) add(body);
}

}  // namespace pliant::mechanics
