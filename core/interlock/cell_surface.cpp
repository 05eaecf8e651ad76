#include "core/interlock/cell_surface.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>

namespace pliant::interlock {

namespace {

using Eigen::Vector3d;

constexpr int around = 16;  // corners of a cross-section

/// Collects points and triangles.
class SurfaceBuilder {
 public:
  int add(const Vector3d& point) {
    points_.push_back(point);
    return static_cast<int>(points_.size()) - 1;
  }
  void addTriangle(int a, int b, int c) { triangles_.push_back({a, b, c}); }
  void addQuad(int a, int b, int c, int d) {
    addTriangle(a, b, c);
    addTriangle(a, c, d);
  }

  /// Circles around the points of a line across its directions, joined; closed if it is a loop.
  void addTube(const std::vector<Vector3d>& line, const std::vector<Vector3d>& directions, double radius, bool loop) {
    const int count = static_cast<int>(line.size()), first = static_cast<int>(points_.size());
    Vector3d normal = directions[0].unitOrthogonal();
    const auto carry = [](const Vector3d& vector, const Vector3d& from, const Vector3d& to) -> Vector3d {
      return Eigen::Quaterniond::FromTwoVectors(from, to) * vector;
    };
    // A frame carried along without twist comes back turned about the tangent: spread over the loop, it closes.
    double twist = 0;
    if (loop) {
      Vector3d carried = normal;
      for (int i = 0; i < count; ++i) carried = carry(carried, directions[i], directions[(i + 1) % count]);
      twist = std::atan2(directions[0].normalized().dot(carried.cross(normal)), carried.dot(normal));
    }
    for (int i = 0; i < count; ++i) {
      if (i > 0) normal = carry(normal, directions[i - 1], directions[i]);
      const Vector3d along = directions[i].normalized();
      const Vector3d first3 = Eigen::AngleAxisd(twist * i / count, along) * normal, second = along.cross(first3);
      for (int k = 0; k < around; ++k) {
        const double angle = 2 * std::numbers::pi * k / around;
        add(line[i] + radius * (std::cos(angle) * first3 + std::sin(angle) * second));
      }
    }
    for (int i = 0; i < (loop ? count : count - 1); ++i)
      for (int k = 0; k < around; ++k) {
        const int next = (i + 1) % count, right = (k + 1) % around;
        addQuad(first + i * around + k, first + i * around + right, first + next * around + right,
                first + next * around + k);
      }
  }

  void addBall(const Vector3d& centre, double radius) {
    const int rows = around / 2, first = static_cast<int>(points_.size());
    for (int i = 1; i < rows; ++i)
      for (int k = 0; k < around; ++k) {
        const double polar = std::numbers::pi * i / rows, angle = 2 * std::numbers::pi * k / around;
        add(centre +
            radius * Vector3d(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)));
      }
    const int top = add(centre + radius * Vector3d::UnitZ()), bottom = add(centre - radius * Vector3d::UnitZ());
    for (int k = 0; k < around; ++k) {
      const int right = (k + 1) % around, last = first + (rows - 2) * around;
      addTriangle(top, first + k, first + right);
      addTriangle(bottom, last + right, last + k);
      for (int i = 0; i + 2 < rows; ++i) {
        const int row = first + i * around;
        addQuad(row + k, row + around + k, row + around + right, row + right);
      }
    }
  }

  geometry::SurfaceMesh mesh() const {
    geometry::SurfaceMesh result;
    result.points.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i) result.points.col(static_cast<Eigen::Index>(i)) = points_[i];
    result.triangles = triangles_;
    return result;
  }

 private:
  std::vector<Vector3d> points_;
  std::vector<std::array<int, 3>> triangles_;
};

void addMesh(const SimplexSet& set, const Eigen::Matrix3d& rotation, const Vector3d& position,
             SurfaceBuilder& builder) {
  std::vector<int> points;
  for (Eigen::Index i = 0; i < set.corners.cols(); ++i)
    points.push_back(builder.add(rotation * set.corners.col(i) + position));
  for (const auto& [a, b, c] : set.triangles) builder.addTriangle(points[a], points[b], points[c]);
}

void addSimplices(const SimplexSet& set, double radius, const Eigen::Matrix3d& rotation, const Vector3d& position,
                  SurfaceBuilder& builder) {
  const Eigen::Matrix3Xd corners = (rotation * set.corners).colwise() + position;
  std::set<std::array<int, 2>> edges;
  std::set<int> used(set.points.begin(), set.points.end());
  for (const auto& [from, to] : set.segments) edges.insert({std::min(from, to), std::max(from, to)});
  for (const auto& [a, b, c] : set.triangles) {
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      edges.insert({std::min(from, to), std::max(from, to)});
    const Vector3d x = corners.col(a), y = corners.col(b), z = corners.col(c);
    const Vector3d offset = radius * (y - x).cross(z - x).normalized();
    builder.addTriangle(builder.add(x + offset), builder.add(y + offset), builder.add(z + offset));
    builder.addTriangle(builder.add(x - offset), builder.add(z - offset), builder.add(y - offset));
  }
  for (const auto& [from, to] : edges) {
    const Vector3d direction = corners.col(to) - corners.col(from);
    builder.addTube({corners.col(from), corners.col(to)}, {direction, direction}, radius, false);
    used.insert({from, to});
  }
  for (const int corner : used) builder.addBall(corners.col(corner), radius);
}

}  // namespace

geometry::SurfaceMesh cellSurface(const UnitCell& cell, const CellState& state, int first, int second, double turn) {
  SurfaceBuilder builder;
  const Eigen::Matrix2d lattice = stretchOf(state.strain) * cell.lattice;
  for (int i = 0; i < first; ++i)
    for (int j = 0; j < second; ++j)
      for (std::size_t k = 0; k < cell.elements.size(); ++k) {
        Vector3d position = state.positions.col(static_cast<Eigen::Index>(k));
        position.head<2>() += lattice * Eigen::Vector2d(i, j);
        for (const DilatedPiece& piece : cell.shapes[cell.elements[k].shape].pieces) {
          const auto* core = std::get_if<ClosedCurve>(&piece.core);
          if (!core) {
            if (isClosedMesh(piece) && piece.radius == 0)
              addMesh(std::get<SimplexSet>(piece.core), state.rotations[k], position, builder);
            else
              addSimplices(std::get<SimplexSet>(piece.core), piece.radius, state.rotations[k], position, builder);
            continue;
          }
          const ClosedCurve curve = core->rotated(state.rotations[k]);
          std::vector<double> parameters = curve.breakpoints(turn);
          parameters.pop_back();
          std::vector<Vector3d> line, directions;
          for (const double t : parameters) {
            const auto point = curve.at(t);
            line.push_back(position + point.place);
            directions.push_back(point.tangent);
          }
          builder.addTube(line, directions, piece.radius, true);
        }
      }
  return builder.mesh();
}

}  // namespace pliant::interlock
