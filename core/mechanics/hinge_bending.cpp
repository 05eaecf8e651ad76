#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/mechanics/hinge_element.hpp"
#include "core/mechanics/shell.hpp"
#include "core/mechanics/shell_checks.hpp"

namespace pliant::mechanics {

namespace {

/// What one triangle brings to the hinge on one of its edges.
struct HingeSide {
  int opposite;        ///< the node that is not on the edge
  double area;         ///< at rest [m²]
  double squaredEdge;  ///< the edge's rest length, squared [m²]
  double rigidity;     ///< D [J]
};

double dihedralAngle(const Vector& x, const std::array<int, 4>& nodes) {
  const auto point = [&](int i) { return x.segment<3>(3 * nodes[i]); };
  const Eigen::Vector3d e = point(1) - point(0), u = point(2) - point(0), v = point(3) - point(0);
  const Eigen::Vector3d n1 = e.cross(u), n2 = v.cross(e);
  return std::atan2(-e.norm() * n1.dot(v), n1.dot(n2));
}

/// The triangles of a shell with where they rest; what it is made from has to outlive it.
class HingeSheet {
 public:
  HingeSheet(const Vector& restPositions, const Triangles& triangles, const Triangles& restTriangles,
             const ShellMaterial& material, const TriangleFactors& factors)
      : rest_(restPositions),
        triangles_(triangles),
        corners_(restCorners(triangles, restTriangles)),
        factors_(factors),
        rigidity_(material.youngModulus * std::pow(material.thickness, 3) /
                  (12 * (1 - material.poissonRatio * material.poissonRatio))) {
    requireElasticMaterial(material);
    requireTriangles(3, rest_, corners_);
    requireTriangleFactors(factors_, triangles_);
  }

  HingeSide sideOf(int triangle, const std::array<int, 2>& edge) const {
    const auto t = static_cast<std::size_t>(triangle);
    const double factor = factorOf(factors_.stiffness, t) * std::pow(factorOf(factors_.thickness, t), 3);
    const std::array<int, 3> at = restOf(triangle, edge);
    return {triangles_[t][cornerOpposite(t, edge)], triangleArea(3, rest_, corners_[t]),
            (rest_.segment<3>(3 * at[1]) - rest_.segment<3>(3 * at[0])).squaredNorm(), factor * rigidity_};
  }

  /// The angle between two triangles as they rest, 0 if the edge rests in two places.
  double restAngle(const geometry::MeshEdge& edge) const {
    const std::array<int, 3> left = restOf(edge.triangles[0], edge.nodes),
                             right = restOf(edge.triangles[1], edge.nodes);
    if (left[0] != right[0] || left[1] != right[1]) return 0;
    return dihedralAngle(rest_, {left[0], left[1], left[2], right[2]});
  }

 private:
  std::size_t cornerOpposite(std::size_t triangle, const std::array<int, 2>& edge) const {
    std::size_t corner = 0;
    while (triangles_[triangle][corner] == edge[0] || triangles_[triangle][corner] == edge[1]) ++corner;
    return corner;
  }

  /// Where the edge's ends and the opposite corner rest.
  std::array<int, 3> restOf(int triangle, const std::array<int, 2>& edge) const {
    const auto t = static_cast<std::size_t>(triangle);
    const std::size_t opposite = cornerOpposite(t, edge);
    std::size_t first = (opposite + 1) % 3, second = (opposite + 2) % 3;
    if (triangles_[t][first] != edge[0]) std::swap(first, second);
    return {corners_[t][first], corners_[t][second], corners_[t][opposite]};
  }

  const Vector& rest_;
  const Triangles& triangles_;
  const Triangles& corners_;
  TriangleFactors factors_;
  double rigidity_;
};

class HingeCollector {
 public:
  void add(const std::array<int, 2>& edge, const HingeSide& left, const HingeSide& right, double restAngle) {
    const double area = left.area + right.area;
    const double rigidity = (left.area * left.rigidity + right.area * right.rigidity) / area;
    const double squaredLength = left.squaredEdge == right.squaredEdge
                                     ? left.squaredEdge
                                     : std::pow(0.5 * (std::sqrt(left.squaredEdge) + std::sqrt(right.squaredEdge)), 2);
    elements_.push_back({0.5 * rigidity * squaredLength / area, restAngle});
    const std::array<int, 4> nodes = {edge[0], edge[1], left.opposite, right.opposite};
    auto& indices = coordinates_.emplace_back();
    for (int i = 0; i < 12; ++i) indices[i] = nodes[i / 3] * 3 + i % 3;
  }

  std::shared_ptr<const Energy> finish() {
    if (elements_.empty()) return nullptr;
    return std::make_shared<ElementEnergy<HingeElement>>(std::move(elements_), std::move(coordinates_));
  }

 private:
  std::vector<HingeElement> elements_;
  std::vector<std::array<int, 12>> coordinates_;
};

}  // namespace

std::shared_ptr<const Energy> makeHingeBending(const Vector& restPositions, const Triangles& triangles,
                                               const ShellMaterial& material, const TriangleFactors& factors,
                                               const Triangles& restTriangles) {
  const HingeSheet sheet(restPositions, triangles, restTriangles, material, factors);
  HingeCollector hinges;
  for (const geometry::MeshEdge& edge : geometry::meshEdges(triangles))
    if (edge.triangles[1] >= 0)
      hinges.add(edge.nodes, sheet.sideOf(edge.triangles[0], edge.nodes), sheet.sideOf(edge.triangles[1], edge.nodes),
                 sheet.restAngle(edge));
  return hinges.finish();
}

std::shared_ptr<const Energy> makeSeamBending(const std::vector<ShellPanel>& panels) {
  std::map<std::array<int, 2>, std::vector<HingeSide>> sidesOfEdge;
  for (const ShellPanel& panel : panels) {
    const HingeSheet sheet(panel.restPositions, panel.triangles, panel.restTriangles, panel.material,
                           {panel.stiffnessFactors, panel.thicknessFactors});
    for (const geometry::MeshEdge& edge : geometry::meshEdges(panel.triangles)) {
      if (edge.triangles[1] >= 0) continue;
      const HingeSide side = sheet.sideOf(edge.triangles[0], edge.nodes);
      std::vector<HingeSide>& sides = sidesOfEdge[edge.nodes];
      const auto same = std::find_if(
          sides.begin(), sides.end(), [&](const HingeSide& other) { return other.opposite == side.opposite; });
      if (same == sides.end())
        sides.push_back(side);
      else
        same->rigidity += side.rigidity;
    }
  }
  HingeCollector hinges;
  for (const auto& [edge, sides] : sidesOfEdge) {
    if (sides.size() > 2)
      throw base::InputError("", "more than two panels are sewn together between nodes " + std::to_string(edge[0]) +
                                     " and " + std::to_string(edge[1]));
    if (sides.size() == 2) hinges.add(edge, sides[0], sides[1], 0);
  }
  return hinges.finish();
}

}  // namespace pliant::mechanics
