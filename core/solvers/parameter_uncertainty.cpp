#include "core/solvers/parameter_uncertainty.hpp"

#include <Eigen/SVD>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pliant::solvers {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ParameterUncertainty parameterUncertainty(const MatrixXd& jacobian, const VectorXd& scales,
                                          const std::vector<char>& held, double sumOfSquares, int otherUnknowns,
                                          double level, double rankTolerance) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  constexpr double share = 1e-3;  // of an undetermined combination that makes a parameter undetermined
  const Index count = jacobian.cols();
  std::vector<Index> free;
  for (Index i = 0; i < count; ++i)
    if (!held[static_cast<std::size_t>(i)]) free.push_back(i);
  const auto freeCount = static_cast<Index>(free.size());
  ParameterUncertainty result;
  result.degreesOfFreedom = static_cast<int>(jacobian.rows() - freeCount) - otherUnknowns;
  if (result.degreesOfFreedom < 1) throw std::invalid_argument("a fit without degrees of freedom");
  result.residualDeviation = std::sqrt(sumOfSquares / result.degreesOfFreedom);
  result.standardErrors = VectorXd::Constant(count, unknown);
  result.halfWidths = result.standardErrors;
  result.correlation = MatrixXd::Constant(count, count, unknown);
  result.correlation.diagonal().setOnes();
  if (free.empty()) return result;

  MatrixXd scaled = jacobian(Eigen::all, free);
  VectorXd units(freeCount);
  for (Index i = 0; i < freeCount; ++i) {
    const double scale = scales[free[static_cast<std::size_t>(i)]];
    units[i] = scale > 0 ? scale : 1;
    scaled.col(i) /= units[i];
  }
  const Eigen::JacobiSVD<MatrixXd> svd(scaled, Eigen::ComputeThinV);
  const VectorXd& values = svd.singularValues();
  Index rank = 0;
  while (rank < values.size() && values[rank] > rankTolerance * values[0]) ++rank;
  const MatrixXd determined = svd.matrixV().leftCols(rank), lost = svd.matrixV().rightCols(freeCount - rank);
  result.undetermined = MatrixXd::Zero(count, lost.cols());
  result.undetermined(free, Eigen::all) = units.cwiseInverse().asDiagonal() * lost;

  const MatrixXd roots = determined * values.head(rank).cwiseInverse().asDiagonal();  // of the inverse, R Rᵀ
  const double t = boost::math::quantile(boost::math::students_t(result.degreesOfFreedom), 0.5 + 0.5 * level);
  const VectorXd lengths = roots.rowwise().norm();
  const auto isDetermined = [&](Index i) {
    return lengths[i] > 0 && (lost.cols() == 0 || lost.row(i).norm() <= share);
  };
  for (Index i = 0; i < freeCount; ++i) {
    if (!isDetermined(i)) continue;
    const Index at = free[static_cast<std::size_t>(i)];
    result.standardErrors[at] = result.residualDeviation * lengths[i] / units[i];
    result.halfWidths[at] = t * result.standardErrors[at];
    for (Index j = 0; j < freeCount; ++j)
      if (j != i && isDetermined(j))
        result.correlation(at, free[static_cast<std::size_t>(j)]) =
            roots.row(i).dot(roots.row(j)) / (lengths[i] * lengths[j]);
  }
  return result;
}

}  // namespace pliant::solvers
