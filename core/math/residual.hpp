#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/math/block_pattern.hpp"

namespace pliant::math {

/// b − A x or b − Aᵀ x for n x m matrices b and x. The columns of a vertex of `pattern` (the pattern of `matrix`) share
/// their row indices, so this runs at the speed at which the values come from memory; spread over the threads.
Eigen::MatrixXd residual(const Eigen::SparseMatrix<double>& matrix, const BlockPattern& pattern, bool transposed,
                         const Eigen::MatrixXd& x, const Eigen::MatrixXd& b);

}  // namespace pliant::math
