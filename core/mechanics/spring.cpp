#include "core/mechanics/spring.hpp"

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"
#include "core/mechanics/element_energy.hpp"

namespace pliant::mechanics {

namespace {

using math::Packet;

double inverseOrZero(double value) { return value > 0 ? 1 / value : 0; }
Packet inverseOrZero(const Packet& value) {
  return Packet::map(
      [](const Packet::Register& p) -> Packet::Register { return p > 0.0 ? 1.0 / p : Packet::Register{}; }, value);
}

/// Energy, force and stiffness of a spring law at the elongation `e`, and force / e.
template <class T>
struct LawValue {
  T energy = 0.0, force = 0.0, stiffness = 0.0, ratio = 0.0;

  LawValue(const SpringLaw& law, const T& e) {
    for (int i = static_cast<int>(law.coefficients.size()) - 1; i >= 0; --i) {
      const double c = law.coefficients[i];
      ratio = ratio * e + c;
      stiffness = stiffness * e + (i + 1) * c;
      energy = energy * e + c / (i + 2);
    }
    force = ratio * e;
    energy = energy * e * e;
  }
};

/// Derivatives of E(|r| - restLength) by r: the gradient f n, and the symmetric Hessian f' n nᵀ + f/|r| (I - n nᵀ)
/// packed. Where |r| = 0 the direction n is undefined: force and stiffness are zero there, but for restLength = 0,
/// where both have limits.
template <class T, int dimension>
T evaluateDistance(const SpringLaw& law, double restLength, const std::array<T, dimension>& r,
                   std::array<T, dimension>& gradient, std::array<T, packedSize(dimension)>& hessian) {
  using std::sqrt;
  T squared = 0.0;
  for (const T& component : r) squared += component * component;
  const T distance = sqrt(squared);
  const T inverse = inverseOrZero(distance);
  const LawValue<T> at(law, distance - restLength);
  const T ratio = restLength == 0 ? at.ratio : at.force * inverse;
  const T along = (at.stiffness - ratio) * inverse * inverse;
  for (int i = 0; i < dimension; ++i) {
    gradient[i] = ratio * r[i];
    for (int j = 0; j <= i; ++j) hessian[packedIndex(i, j)] = along * r[i] * r[j];
    hessian[packedIndex(i, i)] += ratio;
  }
  return at.energy;
}

template <int dimension>
struct SpringElement {
  static constexpr int coordinates = 2 * dimension;
  static constexpr std::string_view name = "spring";

  SpringLaw law;
  double restLength;

  template <class T>
  T evaluate(const std::array<T, coordinates>& x, std::array<T, coordinates>* gradient,
             std::array<T, packedSize(coordinates)>* hessian) const {
    std::array<T, dimension> r, g;
    std::array<T, packedSize(dimension)> h;
    for (int i = 0; i < dimension; ++i) r[i] = x[dimension + i] - x[i];
    const T energy = evaluateDistance<T, dimension>(law, restLength, r, g, h);
    if (gradient)
      for (int i = 0; i < dimension; ++i) {
        (*gradient)[i] = -g[i];
        (*gradient)[dimension + i] = g[i];
      }
    if (hessian)
      for (int i = 0; i < dimension; ++i)
        for (int j = 0; j < dimension; ++j) {
          const T& entry = h[i >= j ? packedIndex(i, j) : packedIndex(j, i)];
          if (j <= i) (*hessian)[packedIndex(i, j)] = (*hessian)[packedIndex(dimension + i, dimension + j)] = entry;
          (*hessian)[packedIndex(dimension + i, j)] = -entry;
        }
    return energy;
  }
};

template <int dimension>
struct AnchoredSpringElement {
  static constexpr int coordinates = dimension;
  static constexpr std::string_view name = "anchored_spring";

  SpringLaw law;
  double restLength;
  std::array<double, dimension> anchor;

  template <class T>
  T evaluate(const std::array<T, coordinates>& x, std::array<T, coordinates>* gradient,
             std::array<T, packedSize(coordinates)>* hessian) const {
    std::array<T, dimension> r, g;
    std::array<T, packedSize(dimension)> h;
    for (int i = 0; i < dimension; ++i) r[i] = x[i] - anchor[i];
    const T energy = evaluateDistance<T, dimension>(law, restLength, r, g, h);
    if (gradient) *gradient = g;
    if (hessian) *hessian = h;
    return energy;
  }
};

template <int dimension>
struct GroundedSpringElement {
  static constexpr int coordinates = dimension;
  static constexpr std::string_view name = "grounded_spring";

  SpringLaw law;
  std::array<double, dimension> rest;
  std::array<double, dimension> direction;

  template <class T>
  T evaluate(const std::array<T, coordinates>& x, std::array<T, coordinates>* gradient,
             std::array<T, packedSize(coordinates)>* hessian) const {
    T elongation = 0.0;
    for (int i = 0; i < dimension; ++i) elongation += (x[i] - rest[i]) * direction[i];
    const LawValue<T> at(law, elongation);
    if (gradient)
      for (int i = 0; i < dimension; ++i) (*gradient)[i] = at.force * direction[i];
    if (hessian)
      for (int i = 0; i < dimension; ++i)
        for (int j = 0; j <= i; ++j) (*hessian)[packedIndex(i, j)] = at.stiffness * (direction[i] * direction[j]);
    return at.energy;
  }
};

void checkLaw(int dimension, const SpringLaw& law) {
  requireDimension(dimension, "a spring");
  if (law.coefficients.empty()) throw base::InputError("", "a spring must have at least one stiffness coefficient");
  for (const double c : law.coefficients) requireFinite(c, "a spring's stiffness coefficient");
}

template <int dimension>
std::array<double, dimension> toArray(const Vector& vector) {
  std::array<double, dimension> result;
  for (int i = 0; i < dimension; ++i) result[i] = vector[i];
  return result;
}

template <int dimension>
std::array<int, dimension> coordinatesOf(int node) {
  std::array<int, dimension> result;
  for (int i = 0; i < dimension; ++i) result[i] = node * dimension + i;
  return result;
}

/// One element as an energy.
template <class Element>
std::shared_ptr<const Energy> single(Element element, const std::array<int, Element::coordinates>& coordinates) {
  return std::make_shared<ElementEnergy<Element>>(std::vector{std::move(element)}, std::vector{coordinates});
}

template <int dimension>
std::shared_ptr<const Energy> springBetween(int nodeA, int nodeB, double restLength, const SpringLaw& law) {
  std::array<int, 2 * dimension> coordinates;
  for (int i = 0; i < dimension; ++i) {
    coordinates[i] = nodeA * dimension + i;
    coordinates[dimension + i] = nodeB * dimension + i;
  }
  return single(SpringElement<dimension>{law, restLength}, coordinates);
}

template <int dimension>
std::shared_ptr<const Energy> springToAnchor(int node, const Vector& anchor, double restLength, const SpringLaw& law) {
  return single(
      AnchoredSpringElement<dimension>{law, restLength, toArray<dimension>(anchor)}, coordinatesOf<dimension>(node));
}

template <int dimension>
std::shared_ptr<const Energy> springToGround(int node, const Vector& rest, const Vector& direction,
                                             const SpringLaw& law) {
  return single(GroundedSpringElement<dimension>{law, toArray<dimension>(rest), toArray<dimension>(direction)},
                coordinatesOf<dimension>(node));
}

}  // namespace

std::shared_ptr<const Energy> makeSpring(int dimension, int nodeA, int nodeB, double restLength, const SpringLaw& law) {
  checkLaw(dimension, law);
  requireNotNegative(restLength, "a spring's rest length");
  if (nodeA == nodeB)
    throw base::InputError("", "a spring must join two different nodes, but both are node " + std::to_string(nodeA));
  return dimension == 1   ? springBetween<1>(nodeA, nodeB, restLength, law)
         : dimension == 2 ? springBetween<2>(nodeA, nodeB, restLength, law)
                          : springBetween<3>(nodeA, nodeB, restLength, law);
}

std::shared_ptr<const Energy> makeAnchoredSpring(int dimension, int node, const Vector& anchor, double restLength,
                                                 const SpringLaw& law) {
  checkLaw(dimension, law);
  requireNotNegative(restLength, "a spring's rest length");
  requireVector(anchor, dimension, "a spring's anchor");
  return dimension == 1   ? springToAnchor<1>(node, anchor, restLength, law)
         : dimension == 2 ? springToAnchor<2>(node, anchor, restLength, law)
                          : springToAnchor<3>(node, anchor, restLength, law);
}

std::shared_ptr<const Energy> makeGroundedSpring(int dimension, int node, const Vector& rest, const Vector& direction,
                                                 const SpringLaw& law) {
  checkLaw(dimension, law);
  requireVector(rest, dimension, "a spring's rest position");
  requireVector(direction, dimension, "a spring's direction");
  if (std::abs(direction.norm() - 1) > 1e-6)
    throw base::InputError(
        "", "a grounded spring's direction must have length 1, but has length " + std::to_string(direction.norm()));
  return dimension == 1   ? springToGround<1>(node, rest, direction, law)
         : dimension == 2 ? springToGround<2>(node, rest, direction, law)
                          : springToGround<3>(node, rest, direction, law);
}

}  // namespace pliant::mechanics
