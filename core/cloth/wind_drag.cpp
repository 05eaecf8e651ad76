#include "core/cloth/wind_drag.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pliant::cloth {

using mechanics::packedIndex;
using mechanics::Vector;

namespace {

/// The assembler's entry of two coordinates, all of which are free.
int entryOf(const mechanics::ElasticAssembler& assembler, int a, int b) {
  const int row = std::max(a, b), column = std::min(a, b);
  const auto& columns = assembler.columns();
  const auto [first, last] = std::equal_range(columns.begin(), columns.end(), column);
  const auto begin = assembler.rows().begin() + (first - columns.begin());
  const auto end = assembler.rows().begin() + (last - columns.begin());
  return static_cast<int>(std::lower_bound(begin, end, row) - assembler.rows().begin());
}

}  // namespace

WindDrag::WindDrag(Wind wind, std::vector<std::array<int, 3>> triangles, const mechanics::ElasticAssembler& assembler)
    : wind_(std::move(wind)), triangles_(std::move(triangles)) {
  for (const auto& triangle : triangles_) {
    auto& entries = entries_.emplace_back();
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j <= i; ++j)
        entries[packedIndex(i, j)] = entryOf(assembler, 3 * triangle[i / 3] + i % 3, 3 * triangle[j / 3] + j % 3);
  }
  normals_.resize(3, static_cast<Eigen::Index>(triangles_.size()));
  strengths_.resize(normals_.cols());
}

void WindDrag::begin(const Eigen::Matrix3Xd& positions, double time) {
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    const Eigen::Vector3d twice =
        (positions.col(b) - positions.col(a)).cross(positions.col(c) - positions.col(a)).eval();
    normals_.col(static_cast<Eigen::Index>(t)) = twice.stableNormalized();
    strengths_[static_cast<Eigen::Index>(t)] = 0.5 * wind_.airDensity * wind_.drag * twice.norm();
  }
  air_ = wind_.velocityAt(time);
}

double WindDrag::relativeSpeed(std::size_t triangle, const Vector& velocities) const {
  const auto& nodes = triangles_[triangle];
  const Eigen::Vector3d mean = (velocities.segment<3>(3 * nodes[0]) + velocities.segment<3>(3 * nodes[1]) +
                                velocities.segment<3>(3 * nodes[2])) /
                               3;
  return (air_ - mean).dot(normals_.col(static_cast<Eigen::Index>(triangle)));
}

double WindDrag::value(const Vector& velocities) const {
  double sum = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    sum += strengths_[static_cast<Eigen::Index>(t)] * std::pow(std::abs(relativeSpeed(t, velocities)), 3) / 6;
  return sum;
}

void WindDrag::addGradient(const Vector& velocities, double factor, Vector& gradient) const {
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const double u = relativeSpeed(t, velocities);
    const Eigen::Vector3d share = -factor * strengths_[static_cast<Eigen::Index>(t)] * std::abs(u) * u / 6 *
                                  normals_.col(static_cast<Eigen::Index>(t));
    for (const int node : triangles_[t]) gradient.segment<3>(3 * node) += share;
  }
}

void WindDrag::addHessian(const Vector& velocities, double factor, Vector& entries) const {
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto normal = normals_.col(static_cast<Eigen::Index>(t));
    const double weight =
        factor * strengths_[static_cast<Eigen::Index>(t)] * std::abs(relativeSpeed(t, velocities)) / 9;
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j <= i; ++j) {
        // Entries of one node's block above its diagonal are the packed ones below, so each pair is visited once.
        entries[entries_[t][packedIndex(i, j)]] += weight * normal[i % 3] * normal[j % 3];
      }
  }
}

}  // namespace pliant::cloth
