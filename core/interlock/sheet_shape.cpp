#include "core/interlock/sheet_shape.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace pliant::interlock {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Shares may be so far below 0 for a point on the rim.
constexpr double rounding = 1e-9;

Matrix2d edgesAtRest(const geometry::SurfaceMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  Matrix2d edges;
  edges << (mesh.points.col(b) - mesh.points.col(a)).head<2>(), (mesh.points.col(c) - mesh.points.col(a)).head<2>();
  return edges;
}

}  // namespace

SheetShape::SheetShape(geometry::SurfaceMesh mesh) : mesh_(std::move(mesh)) {
  low_ = mesh_.points.topRows<2>().rowwise().minCoeff();
  const Vector2d size = mesh_.points.topRows<2>().rowwise().maxCoeff() - low_;
  bin_ = std::sqrt(2 * size.prod() / static_cast<double>(mesh_.triangles.size()));
  columns_ = static_cast<int>(size[0] / bin_) + 1;
  rows_ = static_cast<int>(size[1] / bin_) + 1;
  bins_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const Matrix2d edges = edgesAtRest(mesh_, t);
    inverses_.push_back(edges.inverse());
    areas_.push_back(0.5 * edges.determinant());
    const auto& [a, b, c] = mesh_.triangles[t];
    Eigen::Matrix<double, 2, 3> corners;
    corners << mesh_.points.col(a).head<2>(), mesh_.points.col(b).head<2>(), mesh_.points.col(c).head<2>();
    const Vector2d from = (corners.rowwise().minCoeff() - low_) / bin_,
                   to = (corners.rowwise().maxCoeff() - low_) / bin_;
    for (int j = static_cast<int>(from[1]); j <= std::min(rows_ - 1, static_cast<int>(to[1])); ++j)
      for (int i = static_cast<int>(from[0]); i <= std::min(columns_ - 1, static_cast<int>(to[0])); ++i)
        bins_[binOf(i, j)].push_back(static_cast<int>(t));
  }
}

std::optional<SheetShape::Place> SheetShape::placeOf(const Vector2d& point) const {
  const Vector2d at = (point - low_) / bin_;
  const int i = std::clamp(static_cast<int>(std::floor(at[0])), 0, columns_ - 1);
  const int j = std::clamp(static_cast<int>(std::floor(at[1])), 0, rows_ - 1);
  for (const int t : bins_[binOf(i, j)]) {
    const auto& corners = mesh_.triangles[static_cast<std::size_t>(t)];
    const Vector2d own = inverses_[static_cast<std::size_t>(t)] * (point - mesh_.points.col(corners[0]).head<2>());
    const Vector3d shares(1 - own.sum(), own[0], own[1]);
    if (shares.minCoeff() >= -rounding) return Place{t, shares};
  }
  return std::nullopt;
}

std::vector<SheetShape::Map> SheetShape::nodeMaps(const Eigen::Matrix3Xd& positions) const {
  std::vector<Map> maps(static_cast<std::size_t>(mesh_.points.cols()), Map::Zero());
  std::vector<double> weights(maps.size(), 0);
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh_.triangles[t];
    Map edges;
    edges << positions.col(b) - positions.col(a), positions.col(c) - positions.col(a);
    const Map own = areas_[t] * edges * inverses_[t];
    for (const int node : {a, b, c}) {
      maps[static_cast<std::size_t>(node)] += own;
      weights[static_cast<std::size_t>(node)] += areas_[t];
    }
  }
  for (std::size_t node = 0; node < maps.size(); ++node)
    if (weights[node] > 0) maps[node] /= weights[node];
  return maps;
}

SheetShape::Frame SheetShape::frameAt(const Place& place, const Eigen::Matrix3Xd& positions,
                                      const std::vector<Map>& maps) const {
  const auto& corners = mesh_.triangles[static_cast<std::size_t>(place.triangle)];
  Vector2d point = Vector2d::Zero();
  for (int i = 0; i < 3; ++i)
    point += place.shares[i] * mesh_.points.col(corners[static_cast<std::size_t>(i)]).head<2>();
  Frame frame{Vector3d::Zero(), {}};
  Map map = Map::Zero();
  for (int i = 0; i < 3; ++i) {
    const int node = corners[static_cast<std::size_t>(i)];
    const Map& own = maps[static_cast<std::size_t>(node)];
    const Vector2d from = point - mesh_.points.col(node).head<2>();
    frame.position += place.shares[i] * (positions.col(node) + 0.5 * own * from);
    map += place.shares[i] * own;
  }
  const Vector3d first = map.col(0).normalized(), normal = map.col(0).cross(map.col(1)).normalized();
  Eigen::Matrix3d basis;
  basis << first, normal.cross(first), normal;
  // In the tangent plane F = R S; of a 2 x 2 matrix the rotation is that of (F + cof F).
  const Matrix2d plane = basis.leftCols<2>().transpose() * map;
  const Vector2d turn = Vector2d(plane(0, 0) + plane(1, 1), plane(1, 0) - plane(0, 1)).normalized();
  Eigen::Matrix3d own = Eigen::Matrix3d::Identity();
  own.topLeftCorner<2, 2>() << turn[0], -turn[1], turn[1], turn[0];
  frame.rotation = basis * own;
  return frame;
}

}  // namespace pliant::interlock
