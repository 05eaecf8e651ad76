#include "core/solvers/quadratic_program.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace pliant::solvers {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int maximumIterations = 100;
constexpr double tolerance = 1e-11;

/// The largest step up to 1 along which values stay above 0.
double stepToBoundary(const ArrayXd& values, const ArrayXd& change) {
  double step = 1;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (change[i] < 0) step = std::min(step, -values[i] / change[i]);
  return step;
}

}  // namespace

QuadraticProgramResult solveQuadraticProgram(const MatrixXd& H, const VectorXd& g, const MatrixXd& A,
                                             const VectorXd& b) {
  QuadraticProgramResult result;
  const Eigen::Index m = b.size();
  result.x = H.llt().solve(-g);
  result.multipliers = VectorXd::Zero(m);
  if (m == 0) {
    result.converged = result.x.allFinite();
    return result;
  }
  VectorXd& x = result.x;
  const double size = 1 + std::max(b.cwiseAbs().maxCoeff(), x.cwiseAbs().maxCoeff());
  const double force = std::max(g.cwiseAbs().maxCoeff(), 1e-300);
  // The start balances how far slacks and multipliers are from their bounds.
  ArrayXd slack = (b - A * x).array().max(1e-2 * size);
  ArrayXd z = ArrayXd::Constant(m, std::max(force, 1e-300));
  for (; result.iterations < maximumIterations; ++result.iterations) {
    const VectorXd dual = H * x + g + A.transpose() * z.matrix();
    const ArrayXd primal = (A * x - b).array() + slack;
    const double mean = (slack * z).mean();
    result.residual =
        std::max({dual.cwiseAbs().maxCoeff() / force, primal.abs().maxCoeff() / size, mean / (force * size)});
    if (!std::isfinite(result.residual)) break;
    if (result.residual < tolerance) {
      result.converged = true;
      break;
    }
    const Eigen::LDLT<MatrixXd> system(H + A.transpose() * (z / slack).matrix().asDiagonal() * A);
    VectorXd dx;
    ArrayXd dz, ds;
    const auto direction = [&](const ArrayXd& complementarity) {
      dx = system.solve(-dual - A.transpose() * ((z * primal - complementarity) / slack).matrix());
      ds = -primal - (A * dx).array();
      dz = (-complementarity - z * ds) / slack;
    };
    direction(slack * z);
    const double affine = ((slack + stepToBoundary(slack, ds) * ds) * (z + stepToBoundary(z, dz) * dz)).mean() / mean;
    direction(slack * z + ds * dz - affine * affine * affine * mean);
    const double step = 0.99 * std::min(stepToBoundary(slack, ds), stepToBoundary(z, dz));
    x += step * dx;
    slack += step * ds;
    z += step * dz;
  }
  result.multipliers = z.matrix();
  return result;
}

}  // namespace pliant::solvers
