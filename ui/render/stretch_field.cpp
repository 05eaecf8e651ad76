#include "ui/render/stretch_field.hpp"

#include <Eigen/LU>
#include <cmath>

namespace pliant::render {
namespace {

Eigen::Matrix<double, 3, 2> edges(const Points& p, const std::array<int, 3>& t) {
  Eigen::Matrix<double, 3, 2> result;
  result << p.col(t[1]) - p.col(t[0]), p.col(t[2]) - p.col(t[0]);
  return result;
}

}  // namespace

StretchField::StretchField(const Points& rest, const std::vector<std::array<int, 3>>& triangles)
    : triangles_(triangles) {
  for (const auto& triangle : triangles) {
    const Eigen::Matrix<double, 3, 2> e = edges(rest, triangle);
    const double length = e.col(0).norm();
    const Eigen::Vector3d axis = e.col(0) / length;
    const double along = axis.dot(e.col(1));
    Eigen::Matrix2d plane;
    plane << length, along, 0, (e.col(1) - along * axis).norm();
    inverseRest_.push_back(plane.inverse());
  }
}

Eigen::VectorXd StretchField::values(const Points& positions) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(triangles_.size()));
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Eigen::Matrix<double, 3, 2> f = edges(positions, triangles_[i]) * inverseRest_[i];
    const Eigen::Matrix2d c = f.transpose() * f;
    const double mean = 0.5 * c.trace();
    const double largest = mean + std::hypot(0.5 * (c(0, 0) - c(1, 1)), c(0, 1));
    result[static_cast<Eigen::Index>(i)] = std::sqrt(largest) - 1.0;
  }
  return result;
}

}  // namespace pliant::render
