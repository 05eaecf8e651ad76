#include <utility>

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"
#include "core/mechanics/mechanism.hpp"
#include "core/mechanics/mechanism_elements.hpp"

namespace pliant::mechanics {

namespace {

constexpr int mostSpringNodes = 4;

/// to - from, with each node once and without those that do not matter.
AttachmentPoint differenceOf(const AttachmentPoint& from, const AttachmentPoint& to) {
  AttachmentPoint difference;
  difference.constant = to.constant - from.constant;
  const auto add = [&](const AttachmentPoint::Term& term, double sign) {
    for (AttachmentPoint::Term& known : difference.terms)
      if (known.node == term.node) {
        known.weight += sign * term.weight;
        known.turnedWeight += sign * term.turnedWeight;
        return;
      }
    difference.terms.push_back({term.node, sign * term.weight, sign * term.turnedWeight});
  };
  for (const auto& term : from.terms) add(term, -1);
  for (const auto& term : to.terms) add(term, 1);
  std::erase_if(difference.terms, [](const auto& term) { return term.weight == 0 && term.turnedWeight == 0; });
  return difference;
}

template <int dimension, int n>
std::shared_ptr<const Energy> localSpring(const AttachmentPoint& difference, double restLength, const SpringLaw& law) {
  if constexpr (n < mostSpringNodes)
    if (difference.terms.size() > n) return localSpring<dimension, n + 1>(difference, restLength, law);
  LocalSpringElement<dimension, n> element{law, restLength, {}};
  std::array<int, n * dimension> coordinates;
  for (int axis = 0; axis < dimension; ++axis) element.difference.constant[axis] = difference.constant[axis];
  for (int i = 0; i < n; ++i) {
    const AttachmentPoint::Term& term = difference.terms[static_cast<std::size_t>(i)];
    element.difference.weights[i] = term.weight;
    element.difference.turnedWeights[i] = term.turnedWeight;
    for (int axis = 0; axis < dimension; ++axis) coordinates[i * dimension + axis] = term.node * dimension + axis;
  }
  return std::make_shared<ElementEnergy<LocalSpringElement<dimension, n>>>(
      std::vector{std::move(element)}, std::vector{coordinates});
}

}  // namespace

AttachmentPoint attachedToNode(int dimension, int node) { return {{{node, 1, 0}}, Vector::Zero(dimension)}; }

AttachmentPoint fixedPlace(const Vector& place) { return {{}, place}; }

AttachmentPoint attachedToLink(int dimension, const Vector& restPositions, int a, int b, double along, double across) {
  requireDimension(dimension, "a point on a link");
  const std::array<int, 2> joints = {a, b};
  requireNodes(joints, static_cast<int>(restPositions.size()) / dimension, "a point on a link");
  requireFinite(along, "a point's coordinate along a link");
  requireFinite(across, "a point's coordinate across a link");
  if (dimension != 2 && across != 0)
    throw base::InputError("", "a point on a link has no coordinate across it, but in 2 dimensions");
  const double length =
      (restPositions.segment(b * dimension, dimension) - restPositions.segment(a * dimension, dimension)).norm();
  if (!(length > 0)) throw base::InputError("", "a link must have two joints at different places");
  const double s = along / length, t = across / length;
  return {{{a, 1 - s, -t}, {b, s, t}}, Vector::Zero(dimension)};
}

Vector positionOf(const AttachmentPoint& point, int dimension, const Vector& positions) {
  Vector place = point.constant;
  for (const AttachmentPoint::Term& term : point.terms) {
    const Vector node = positions.segment(term.node * dimension, dimension);
    place += term.weight * node;
    if (dimension != 2) continue;
    place[0] -= term.turnedWeight * node[1];
    place[1] += term.turnedWeight * node[0];
  }
  return place;
}

std::shared_ptr<const Energy> makeLocalSpring(int dimension, const AttachmentPoint& from, const AttachmentPoint& to,
                                              double restLength, const SpringLaw& law) {
  requireDimension(dimension, "a spring");
  requireSpringLaw(law);
  requireNotNegative(restLength, "a spring's rest length");
  requireVector(from.constant, dimension, "a spring's end");
  requireVector(to.constant, dimension, "a spring's end");
  const AttachmentPoint difference = differenceOf(from, to);
  if (difference.terms.empty())
    throw base::InputError("", "a spring must join two points that can move against one another");
  return dimension == 1   ? localSpring<1, 1>(difference, restLength, law)
         : dimension == 2 ? localSpring<2, 1>(difference, restLength, law)
                          : localSpring<3, 1>(difference, restLength, law);
}

}  // namespace pliant::mechanics
