#include "core/geometry/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/simplex_distance.hpp"

namespace pliant::geometry {

namespace {

constexpr int leafTriangles = 4;

}  // namespace

SurfaceDistance::SurfaceDistance(SurfaceMesh mesh) : mesh_(std::move(mesh)) {
  checkClosed(mesh_);
  const auto count = static_cast<int>(mesh_.triangles.size());
  faceNormals_.resize(3, count);
  vertexNormals_.setZero(3, mesh_.points.cols());
  for (int t = 0; t < count; ++t) {
    const auto& corners = mesh_.triangles[t];
    const auto side = [&](int i) -> Eigen::Vector3d {
      return (mesh_.points.col(corners[(i + 1) % 3]) - mesh_.points.col(corners[i])).normalized();
    };
    faceNormals_.col(t) = side(0).cross(-side(2)).normalized();
    for (int i = 0; i < 3; ++i) {
      const double angle = std::acos(std::clamp(-side(i).dot(side((i + 2) % 3)), -1.0, 1.0));
      vertexNormals_.col(corners[i]) += angle * faceNormals_.col(t);
    }
  }
  edgeNormals_.resize(static_cast<std::size_t>(count));
  for (const MeshEdge& edge : meshEdges(mesh_.triangles)) {
    const Eigen::Vector3d normal = faceNormals_.col(edge.triangles[0]) + faceNormals_.col(edge.triangles[1]);
    for (const int t : edge.triangles)
      for (int i = 0; i < 3; ++i) {
        const int a = mesh_.triangles[t][i], b = mesh_.triangles[t][(i + 1) % 3];
        if (std::minmax(a, b) == std::minmax(edge.nodes[0], edge.nodes[1])) edgeNormals_[t][i] = normal;
      }
  }
  order_.resize(static_cast<std::size_t>(count));
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(static_cast<std::size_t>(count));
  buildNode(0, count);
}

int SurfaceDistance::buildNode(int first, int count) {
  const auto index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Eigen::AlignedBox3d box, centres;
  const auto centre = [this](int t) -> Eigen::Vector3d {
    const auto& [a, b, c] = mesh_.triangles[t];
    return mesh_.points.col(a) + mesh_.points.col(b) + mesh_.points.col(c);
  };
  for (int k = first; k < first + count; ++k) {
    for (const int corner : mesh_.triangles[order_[k]]) box.extend(mesh_.points.col(corner));
    centres.extend(centre(order_[k]));
  }
  nodes_[index].box = box;
  if (count <= leafTriangles) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return index;
  }
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const int half = count / 2;
  // Ties by number, so that the tree depends on the mesh alone.
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](int s, int t) { return std::pair(centre(s)[axis], s) < std::pair(centre(t)[axis], t); });
  const int left = buildNode(first, half), right = buildNode(first + half, count - half);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

SurfaceDistance::Closest SurfaceDistance::closest(const Eigen::Vector3d& p) const {
  double best = std::numeric_limits<double>::infinity();
  Closest result;
  Eigen::Vector3d shares = Eigen::Vector3d::Zero();  // of the triangle's corners
  std::array<std::pair<double, int>, 64> stack;      // deep enough for a balanced tree of 2^62 leaves
  int top = 0;
  stack[top++] = {nodes_.front().box.squaredExteriorDistance(p), 0};
  while (top > 0) {
    const auto [lower, index] = stack[--top];
    if (lower >= best) continue;
    const Node& node = nodes_[index];
    if (node.count == 0) {
      std::pair<double, int> near{nodes_[node.left].box.squaredExteriorDistance(p), node.left};
      std::pair<double, int> far{nodes_[node.right].box.squaredExteriorDistance(p), node.right};
      if (far.first < near.first) std::swap(near, far);
      if (far.first < best) stack[top++] = far;
      if (near.first < best) stack[top++] = near;
      continue;
    }
    for (int k = node.first; k < node.first + node.count; ++k) {
      const int t = order_[k];
      Corners corners;
      corners.col(0) = p;
      for (int i = 0; i < 3; ++i) corners.col(i + 1) = mesh_.points.col(mesh_.triangles[t][i]);
      const ClosestPoints found = closestPoints(SimplexPair::pointTriangle, corners);
      if (found.squaredDistance >= best) continue;
      best = found.squaredDistance;
      result.triangle = t;
      shares = -found.weights.tail<3>();
    }
  }
  const auto& corners = mesh_.triangles[result.triangle];
  result.point.setZero();
  for (int i = 0; i < 3; ++i) result.point += shares[i] * mesh_.points.col(corners[i]);
  const auto used = static_cast<int>((shares.array() != 0).count());
  Eigen::Vector3d normal = faceNormals_.col(result.triangle), edge = Eigen::Vector3d::Zero();
  if (used == 1) {
    result.feature = Feature::vertex;
    for (int i = 0; i < 3; ++i)
      if (shares[i] != 0) normal = vertexNormals_.col(corners[i]);
  } else if (used == 2) {
    result.feature = Feature::edge;
    for (int i = 0; i < 3; ++i)
      if (shares[i] != 0 && shares[(i + 1) % 3] != 0) {
        normal = edgeNormals_[result.triangle][i];
        edge = (mesh_.points.col(corners[(i + 1) % 3]) - mesh_.points.col(corners[i])).normalized();
      }
  }
  const Eigen::Vector3d offset = p - result.point;
  const double length = std::sqrt(best);
  const double sign = offset.dot(normal) < 0 ? -1 : 1;
  result.distance = sign * length;
  if (result.feature == Feature::face || length == 0)
    result.gradient = normal.normalized();
  else
    result.gradient = offset / result.distance;
  if (result.feature != Feature::face && length > 0)
    result.hessian =
        (Eigen::Matrix3d::Identity() - result.gradient * result.gradient.transpose() - edge * edge.transpose()) /
        result.distance;
  return result;
}

}  // namespace pliant::geometry
