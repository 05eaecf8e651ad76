#pragma once

#include <Eigen/Core>

namespace pliant::render {

using Points = Eigen::Matrix3Xd;  ///< one column a point [m]

/// Positions of all nodes (size n * dimension) as points, padded with 0.
Points toPoints(const Eigen::VectorXd& coordinates, int nodes, int dimension);

}  // namespace pliant::render
