#include "core/geometry/editable_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

namespace pliant::geometry {

namespace {

using Eigen::Vector3d;

/// On the surface: where parts of a body run into each other, by going to the one and the other in turn.
Vector3d ontoSurface(const BodyDistance& body, Vector3d place, double tolerance) {
  for (int i = 0; i < 60; ++i) {
    const SurfacePlace seen = body(place);
    if (std::abs(seen.distance) <= tolerance) break;
    place = seen.nearest;
  }
  return place;
}

}  // namespace

EditableMesh::EditableMesh(const SurfaceMesh& mesh) {
  std::vector<int> index(mesh.points.cols(), -1);
  for (std::array<int, 3> triangle : mesh.triangles) {
    for (int& node : triangle) {
      if (index[node] < 0) {
        index[node] = static_cast<int>(points_.size());
        points_.emplace_back(mesh.points.col(node));
        around_.emplace_back();
      }
      node = index[node];
      around_[node].push_back(static_cast<int>(triangles_.size()));
    }
    triangles_.push_back(triangle);
  }
}

std::vector<EditableMesh::Edge> EditableMesh::edges() const {
  std::vector<Edge> result;
  for (const auto& [a, b, c] : triangles_) {
    if (a < 0) continue;
    for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}})
      if (edge[0] < edge[1]) result.push_back(edge);  // the other triangle has it the other way round
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::array<int, 2> EditableMesh::trianglesAt(const Edge& edge) const {
  std::array<int, 2> result = {-1, -1};
  for (const int t : around_[edge[0]])
    for (int i = 0; i < 3; ++i) {
      if (triangles_[t][i] != edge[0]) continue;
      if (triangles_[t][(i + 1) % 3] == edge[1]) result[0] = t;
      if (triangles_[t][(i + 2) % 3] == edge[1]) result[1] = t;
    }
  return result;
}

int EditableMesh::oppositeCorner(int triangle, const Edge& edge) const {
  for (const int corner : triangles_[triangle])
    if (corner != edge[0] && corner != edge[1]) return corner;
  return -1;
}

std::vector<int> EditableMesh::neighboursOf(int point) const {
  std::set<int> result;
  for (const int t : around_[point])
    for (const int corner : triangles_[t])
      if (corner != point) result.insert(corner);
  return {result.begin(), result.end()};
}

Vector3d EditableMesh::normalOf(const std::array<int, 3>& corners) const {
  const auto& [a, b, c] = corners;
  return (points_[b] - points_[a]).cross(points_[c] - points_[a]);
}

bool EditableMesh::staysUpright(int point, const Vector3d& to, int except) const {
  for (const int t : around_[point]) {
    const auto& corners = triangles_[t];
    if (std::find(corners.begin(), corners.end(), except) != corners.end()) continue;
    std::array<Vector3d, 3> moved;
    for (int i = 0; i < 3; ++i) moved[i] = corners[i] == point ? to : points_[corners[i]];
    const Vector3d before = normalOf(corners), after = (moved[1] - moved[0]).cross(moved[2] - moved[0]);
    const auto longest = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
      return std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    };
    // Slivers have no sense worth keeping, and may stay slivers.
    constexpr double sliver = 0.05;
    if (before.norm() < sliver * longest(points_[corners[0]], points_[corners[1]], points_[corners[2]])) continue;
    if (after.norm() < sliver * longest(moved[0], moved[1], moved[2]) ||
        after.dot(before) < 0.5 * after.norm() * before.norm())
      return false;
  }
  return true;
}

void EditableMesh::replaceCorner(int triangle, int from, int to) {
  std::replace(triangles_[triangle].begin(), triangles_[triangle].end(), from, to);
  around_[to].push_back(triangle);
}

void EditableMesh::forget(int point, int triangle) {
  auto& list = around_[point];
  list.erase(std::find(list.begin(), list.end(), triangle));
}

void EditableMesh::collapse(const Edge& edge, const Vector3d& to) {
  const auto [a, b] = edge;
  for (const int t : trianglesAt(edge)) {
    const std::array<int, 3> corners = triangles_[t];
    for (const int corner : corners) forget(corner, t);
    triangles_[t] = {-1, -1, -1};
  }
  for (const int t : around_[b]) replaceCorner(t, b, a);
  around_[b].clear();
  points_[a] = to;
}

void EditableMesh::split(const Edge& edge, const Vector3d& at) {
  const auto [a, b] = edge;
  const int middle = static_cast<int>(points_.size());
  points_.push_back(at);
  around_.emplace_back();
  for (const int t : trianglesAt(edge)) {
    const int added = static_cast<int>(triangles_.size()), opposite = oppositeCorner(t, edge);
    std::array<int, 3> half = triangles_[t];
    std::replace(half.begin(), half.end(), a, middle);
    triangles_.push_back(half);
    for (const int corner : {middle, b, opposite}) around_[corner].push_back(added);
    forget(b, t);
    replaceCorner(t, b, middle);
  }
}

void EditableMesh::collapseShortEdges(const BodyDistance& body, double length, bool always) {
  std::vector<std::pair<double, Edge>> shortEdges;
  for (const Edge& edge : edges())
    if (const double own = (points_[edge[0]] - points_[edge[1]]).norm(); own < length)
      shortEdges.push_back({own, edge});
  std::sort(shortEdges.begin(), shortEdges.end());
  for (const auto& [before, edge] : shortEdges) {
    const auto [a, b] = edge;
    const auto [first, second] = trianglesAt(edge);
    if (first < 0 || (points_[a] - points_[b]).norm() >= length) continue;
    const std::vector<int> nearA = neighboursOf(a), nearB = neighboursOf(b);
    std::vector<int> common;
    std::set_intersection(nearA.begin(), nearA.end(), nearB.begin(), nearB.end(), std::back_inserter(common));
    // Else two sheets would become one, or an opposite corner would be left with two triangles.
    if (common.size() != 2 || around_[common[0]].size() < 4 || around_[common[1]].size() < 4) continue;
    const Vector3d to = ontoSurface(body, 0.5 * (points_[a] + points_[b]), 1e-3 * length);
    if (always || (staysUpright(a, to, b) && staysUpright(b, to, a))) collapse(edge, to);
  }
}

void EditableMesh::flipEdges() {
  for (const Edge& edge : edges()) {
    const int a = edge[0], b = edge[1];
    const auto [first, second] = trianglesAt(edge);
    if (first < 0) continue;
    const int c = oppositeCorner(first, edge), d = oppositeCorner(second, edge);
    const auto angleAt = [&](int at) {
      const Vector3d toA = points_[a] - points_[at], toB = points_[b] - points_[at];
      return std::atan2(toA.cross(toB).norm(), toA.dot(toB));
    };
    if (angleAt(c) + angleAt(d) < 1.05 * std::numbers::pi) continue;
    const std::vector<int> nearC = neighboursOf(c);
    if (std::binary_search(nearC.begin(), nearC.end(), d) || around_[a].size() < 4 || around_[b].size() < 4) continue;
    const Vector3d before = normalOf(triangles_[first]) + normalOf(triangles_[second]);
    const std::array<int, 3> withA = {c, a, d}, withB = {d, b, c};
    bool upright = true;
    for (const auto& corners : {withA, withB}) {
      const Vector3d after = normalOf(corners);
      upright = upright && after.dot(before) > 0.9 * after.norm() * before.norm();
    }
    if (!upright) continue;
    forget(b, first);
    forget(a, second);
    triangles_[first] = withA;
    triangles_[second] = withB;
    around_[d].push_back(first);
    around_[c].push_back(second);
  }
}

void EditableMesh::relax(const BodyDistance& body) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (around_[i].empty()) continue;
    const int point = static_cast<int>(i);
    const std::vector<int> near = neighboursOf(point);
    Vector3d middle = Vector3d::Zero();
    for (const int other : near) middle += points_[other] / static_cast<double>(near.size());
    const Vector3d to = ontoSurface(body, middle, 1e-3 * (points_[near[0]] - points_[i]).norm());
    if (staysUpright(point, to)) points_[i] = to;
  }
}

SurfaceFit EditableMesh::splitToTolerance(const BodyDistance& body, double tolerance) {
  const double exact = 0.01 * tolerance;
  for (Vector3d& point : points_) point = ontoSurface(body, point, exact);
  // Points stay where they are from here on, so that what was looked at once is done.
  std::set<Edge> doneEdges;
  std::set<std::array<int, 3>> doneTriangles;
  SurfaceFit fit;
  // Halving is done after few passes, but around openings that the mesh does not have it could go on for ever.
  constexpr int mostPasses = 16;
  const auto lengthOf = [&](const Edge& edge) { return (points_[edge[0]] - points_[edge[1]]).norm(); };
  for (int pass = 0;; ++pass) {
    std::map<Edge, double> wrong;  // with how much
    for (const Edge& edge : edges()) {
      if (doneEdges.count(edge)) continue;
      const double own = std::abs(body(0.5 * (points_[edge[0]] + points_[edge[1]])).distance);
      if (own > tolerance && lengthOf(edge) > 2 * tolerance)
        wrong[edge] = own;
      else
        doneEdges.insert(edge), fit.deviation = std::max(fit.deviation, own);
    }
    for (const auto& corners : triangles_) {
      const auto& [a, b, c] = corners;
      if (a < 0 || doneTriangles.count(corners)) continue;
      const double own = std::abs(body((points_[a] + points_[b] + points_[c]) / 3).distance);
      Edge longest = {a, a};
      bool crosses = false;
      for (const Edge& edge : {Edge{std::min(a, b), std::max(a, b)}, Edge{std::min(b, c), std::max(b, c)},
                               Edge{std::min(c, a), std::max(c, a)}}) {
        if (lengthOf(edge) > lengthOf(longest)) longest = edge;
        crosses = crosses || stuck_.count(edge);
      }
      if (own > tolerance && lengthOf(longest) > 2 * tolerance && !crosses) {
        wrong.try_emplace(longest, own);
        continue;
      }
      doneTriangles.insert(corners);
      double& largest = own > tolerance && crosses ? fit.filled : fit.deviation;
      largest = std::max(largest, own);
    }
    if (pass == mostPasses)
      for (const auto& [edge, own] : wrong) fit.filled = std::max(fit.filled, own);
    if (wrong.empty() || pass == mostPasses) return fit;
    std::vector<std::pair<double, Edge>> order;
    for (const auto& [edge, own] : wrong) order.push_back({-lengthOf(edge), edge});
    std::sort(order.begin(), order.end());
    for (const auto& [length, edge] : order) {
      const Vector3d at = ontoSurface(body, 0.5 * (points_[edge[0]] + points_[edge[1]]), exact);
      double nearest = std::numeric_limits<double>::infinity();  // of the corners opposite: along creases two points
                                                                 // may go to one place
      for (const int t : trianglesAt(edge)) nearest = std::min(nearest, (at - points_[oppositeCorner(t, edge)]).norm());
      // Else both ends of the edge are on walls that face each other, and so would be those of a half.
      if (std::max((at - points_[edge[0]]).norm(), (at - points_[edge[1]]).norm()) < -0.85 * length &&
          nearest > -0.05 * length) {
        split(edge, at);
        continue;
      }
      stuck_.insert(edge);
      doneEdges.insert(edge);
      fit.filled = std::max(fit.filled, wrong[edge]);
    }
  }
}

SurfaceMesh EditableMesh::finish() const {
  SurfaceMesh mesh;
  std::vector<int> index(points_.size(), -1);
  int count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (!around_[i].empty()) index[i] = count++;
  mesh.points.resize(3, count);
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (index[i] >= 0) mesh.points.col(index[i]) = points_[i];
  for (const auto& [a, b, c] : triangles_)
    if (a >= 0) mesh.triangles.push_back({index[a], index[b], index[c]});
  return mesh;
}

}  // namespace pliant::geometry
