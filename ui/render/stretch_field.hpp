#pragma once

#include "ui/render/primitives.hpp"

namespace pliant::render {

/// How far each triangle is stretched in its plane, measured against the rest shape.
class StretchField {
 public:
  StretchField() = default;
  StretchField(const Points& rest, const std::vector<std::array<int, 3>>& triangles);

  /// Largest principal stretch − 1, one a triangle.
  Eigen::VectorXd values(const Points& positions) const;

 private:
  std::vector<std::array<int, 3>> triangles_;
  std::vector<Eigen::Matrix2d> inverseRest_;
};

}  // namespace pliant::render
