#include "core/mechanics/element_stress.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <set>

#include "core/mechanics/hinge_element.hpp"
#include "core/mechanics/membrane_element.hpp"
#include "core/mechanics/solid_element.hpp"

namespace pliant::mechanics {

namespace {

template <std::size_t N>
std::array<int, N> sortedCorners(std::array<int, N> corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

template <int dimension>
Eigen::Matrix2d restMetricOf(const MembraneElement<dimension>& element) {
  const auto& [a11, a22, a12] = element.restMetric;
  return (Eigen::Matrix2d() << a11, a12, a12, a22).finished();
}

Eigen::Matrix3d restMetricOf(const SolidElement& element) {
  Eigen::Matrix3d metric;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) metric(i, j) = element.restMetric[packedIndex(std::max(i, j), std::min(i, j))];
  return metric;
}

}  // namespace

template <class Element, int D>
void ElementStress::addBodies(const Energy& energy, int index, const std::vector<double>& scales,
                              const std::vector<std::array<int, D + 1>>& chosen, std::vector<Body<D>>& bodies) const {
  const auto* made = dynamic_cast<const ElementEnergy<Element>*>(&energy);
  if (!made) return;
  std::set<std::array<int, D + 1>> wanted;
  for (const auto& corners : chosen) wanted.insert(sortedCorners(corners));
  for (int e = 0; e < made->elementCount(); ++e) {
    Body<D> body;
    for (std::size_t corner = 0; corner <= D; ++corner)
      body.nodes[corner] = made->elementCoordinates(e)[corner * static_cast<std::size_t>(dimension_)] / dimension_;
    if (!wanted.contains(sortedCorners(body.nodes))) continue;
    const Element& element = made->elements()[static_cast<std::size_t>(e)];
    const Square<D> restEdges = restMetricOf(element).llt().matrixU();
    body.inverse = restEdges.inverse();
    const double scale = scales.empty() ? 1 : scales[static_cast<std::size_t>(e)];
    body.lambda = scale * element.material.lambda;
    body.twoMu = scale * element.material.twoMu;
    if (D == 2) {
      body.thinning = body.lambda / body.twoMu;
      body.thickness = 2 * element.material.volume / restEdges.determinant();  // V = A h, the determinant is 2 A
    }
    body.place = {index, e};
    bodies.push_back(std::move(body));
  }
}

ElementStress::ElementStress(const Model& model, const Triangles& triangles, const Tetrahedra& tetrahedra,
                             ElementMeasure measure)
    : dimension_(model.dimension), measure_(measure) {
  for (int i = 0; i < static_cast<int>(model.energies.size()); ++i) {
    const FactoredParts parts = withoutFactors(model.energies[static_cast<std::size_t>(i)]);
    if (dimension_ == 2) addBodies<MembraneElement<2>, 2>(*parts.elements, i, parts.scales, triangles, triangles_);
    if (dimension_ != 3) continue;
    addBodies<MembraneElement<3>, 2>(*parts.elements, i, parts.scales, triangles, triangles_);
    addBodies<SolidElement, 3>(*parts.elements, i, parts.scales, tetrahedra, tetrahedra_);
  }
  TrianglesByCorners byCorners;
  const auto isFree = [&](int node) {
    const auto* first = model.dofs.freeIndex.data() + node * dimension_;
    return std::any_of(first, first + dimension_, [](int index) { return index >= 0; });
  };
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    if (const auto& nodes = triangles_[t].nodes; std::any_of(nodes.begin(), nodes.end(), isFree))
      byCorners.emplace(sortedCorners(nodes), t);
  for (const auto& energy : model.energies) addHinges(*energy, byCorners);
  const auto enter = [&](const auto& bodies) {
    for (const auto& body : bodies) elements_.insert(elements_.end(), body.placeCount(), body.place);
  };
  enter(triangles_);
  enter(tetrahedra_);
  count_ = static_cast<int>(elements_.size());
}

void ElementStress::addHinges(const Energy& energy, const TrianglesByCorners& triangles) {
  const auto* hinges = dynamic_cast<const ElementEnergy<HingeElement>*>(&energy);
  for (int h = 0; hinges && h < hinges->elementCount(); ++h) {
    const HingeElement& element = hinges->elements()[static_cast<std::size_t>(h)];
    Hinge hinge{{}, element.stiffness, element.restAngle};
    for (std::size_t i = 0; i < 4; ++i) hinge.nodes[i] = hinges->elementCoordinates(h)[3 * i] / 3;
    const auto [from, to, left, right] = hinge.nodes;
    const auto index = static_cast<int>(hinges_.size());
    bool isWanted = false;
    // Corners in the order in which the angle's normals look at both.
    for (const std::array<int, 3>& corners : {std::array{from, to, left}, std::array{to, from, right}}) {
      const auto [first, last] = triangles.equal_range(sortedCorners(corners));
      for (auto found = first; found != last; ++found, isWanted = true)
        addSide(index, corners, triangles_[found->second]);
    }
    if (isWanted) hinges_.push_back(hinge);
  }
}

void ElementStress::addSide(int hinge, const std::array<int, 3>& corners, Body<2>& body) const {
  const auto at = [&](int node) {
    return static_cast<int>(std::find(body.nodes.begin(), body.nodes.end(), node) - body.nodes.begin());
  };
  const int from = at(corners[0]), to = at(corners[1]), opposite = at(corners[2]);
  const double orientation = (from + 1) % 3 == to ? 1 : -1;
  // Corners of the triangle at rest, the first at the origin.
  Eigen::Matrix<double, 2, 3> rest = Eigen::Matrix<double, 2, 3>::Zero();
  rest.rightCols<2>() = body.inverse.inverse();
  const Eigen::Vector2d edge = rest.col(to) - rest.col(from), normal(-edge[1] / edge.norm(), edge[0] / edge.norm());
  const Eigen::Vector2d one = rest.col(opposite) - rest.col(from), two = rest.col(opposite) - rest.col(to);
  const Eigen::Matrix2d moments =
      0.5 * (one * two.transpose() + two * one.transpose()) / (normal.dot(one) * normal.dot(two));
  body.sides.push_back({hinge, orientation * 6 / (body.thickness * body.thickness * edge.norm()) * moments});
}

}  // namespace pliant::mechanics
