#pragma once

#include <Eigen/LU>
#include <random>

#include "core/solvers/cone_program.hpp"

namespace pliant::tests {

/// A square sheet of side 1 with n x n cells in the plane z = 0 that nothing limits yet; 0.1 kg.
struct Sheet {
  solvers::ConeConstraints constraints;
  Eigen::Matrix3Xd rest;
};

inline Sheet makeSheet(int n) {
  Sheet sheet;
  const int side = n + 1;
  sheet.rest.resize(3, side * side);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) sheet.rest.col(i * side + j) << double(j) / n, double(i) / n, 0;
  sheet.constraints.nodeCount = side * side;
  sheet.constraints.masses = Eigen::VectorXd::Zero(side * side);
  sheet.constraints.fixed.assign(side * side, 0);
  const auto add = [&](int a, int b, int c) {
    Eigen::Matrix2d edges;
    edges << (sheet.rest.col(b) - sheet.rest.col(a)).head<2>(), (sheet.rest.col(c) - sheet.rest.col(a)).head<2>();
    const Eigen::Matrix2d inverse = edges.inverse();
    const Eigen::Vector2d one = inverse.row(0).transpose(), two = inverse.row(1).transpose();
    sheet.constraints.elements.push_back({{a, b, c}, {Eigen::Vector2d(-one - two), one, two}, 0});
    for (const int node : {a, b, c}) sheet.constraints.masses[node] += 0.1 * edges.determinant() / 6;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int v = i * side + j;
      if ((i + j) % 2 == 0) {
        add(v, v + 1, v + side);
        add(v + 1, v + side + 1, v + side);
      } else {
        add(v, v + 1, v + side + 1);
        add(v, v + side + 1, v + side);
      }
    }
  return sheet;
}

inline solvers::MetricBounds isotropicBound(double stretch) {
  return {{stretch * stretch * Eigen::Matrix2d::Identity()}, {}};
}

inline solvers::MetricBounds directionBounds(double stretch, int count) {
  solvers::MetricBounds bounds;
  for (int i = 0; i < count; ++i)
    bounds.directions.emplace_back(std::cos(M_PI * i / count) / stretch, std::sin(M_PI * i / count) / stretch);
  return bounds;
}

/// The sheet drawn out, sheared and shaken: most triangles break a limit of a few per cent.
inline Eigen::Matrix3Xd disturbed(const Eigen::Matrix3Xd& rest, double amount, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  map(0, 0) += amount;
  map(0, 1) += amount;
  map(2, 1) += 2 * amount;
  const double noise = 0.2 * amount / std::sqrt(static_cast<double>(rest.cols()));
  Eigen::Matrix3Xd moved = map * rest;
  for (Eigen::Index i = 0; i < moved.size(); ++i) moved.data()[i] += noise * uniform(generator);
  return moved;
}

}  // namespace pliant::tests
