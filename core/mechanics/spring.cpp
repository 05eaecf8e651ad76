#include "core/mechanics/spring.hpp"

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"
#include "core/mechanics/element_energy.hpp"
#include "core/mechanics/spring_law.hpp"

namespace pliant::mechanics {

namespace {

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
  requireSpringLaw(law);
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
