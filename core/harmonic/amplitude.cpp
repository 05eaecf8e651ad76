#include "core/harmonic/amplitude.hpp"

#include <algorithm>

namespace pliant::harmonic {

Amplitude amplitude(const HarmonicBalanceProblem& problem, const Vector& z, int node) {
  const Matrix path = problem.nodeTrajectory(z, node);
  const Eigen::RowVectorXd mean = path.colwise().mean();
  Amplitude result;
  for (Eigen::Index i = 0; i < path.rows(); ++i) {
    result.pathLength += (path.row((i + 1) % path.rows()) - path.row(i)).norm();
    result.maximumDisplacement = std::max(result.maximumDisplacement, (path.row(i) - mean).norm());
  }
  return result;
}

Vector pathLengthGradient(const HarmonicBalanceProblem& problem, const Vector& z, int node) {
  const Matrix path = problem.nodeTrajectory(z, node);
  Matrix pathGradient = Matrix::Zero(path.rows(), path.cols());
  for (Eigen::Index i = 0; i < path.rows(); ++i) {
    const Eigen::Index next = (i + 1) % path.rows();
    const Eigen::RowVectorXd segment = path.row(next) - path.row(i);
    const double length = segment.norm();
    if (length == 0) continue;
    pathGradient.row(next) += segment / length;
    pathGradient.row(i) -= segment / length;
  }
  const int dimension = problem.model().dimension;
  const Eigen::Index width = problem.basis().size();
  Vector gradient = Vector::Zero(problem.size());
  for (int axis = 0; axis < dimension; ++axis) {
    const int f = problem.model().dofs.freeIndex[node * dimension + axis];
    if (f >= 0) gradient.segment(f * width, width) = problem.basis().synthesis().transpose() * pathGradient.col(axis);
  }
  return gradient;
}

}  // namespace pliant::harmonic
