#include "core/solvers/hermite_curve.hpp"

namespace pliant::solvers {

void HermiteCurve::add(double s, const Eigen::VectorXd& value, const Eigen::VectorXd& derivative) {
  for (int copy = 0; copy < 2; ++copy) {
    nodes_.push_back(s);
    const std::size_t order = nodes_.size();
    std::vector<Eigen::VectorXd> differences = {value};
    for (std::size_t k = 1; k < order; ++k) {
      if (k == 1 && copy == 1)
        differences.push_back(derivative);
      else
        differences.push_back((differences[k - 1] - lastDifferences_[k - 1]) / (s - nodes_[order - 1 - k]));
    }
    coefficients_.push_back(differences.back());
    lastDifferences_ = std::move(differences);
  }
}

Eigen::VectorXd HermiteCurve::value(double s) const {
  Eigen::VectorXd sum = coefficients_.back();
  for (std::size_t k = coefficients_.size() - 1; k-- > 0;) sum = coefficients_[k] + (s - nodes_[k]) * sum;
  return sum;
}

Eigen::VectorXd HermiteCurve::derivative(double s) const {
  Eigen::VectorXd sum = coefficients_.back();
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(sum.size());
  for (std::size_t k = coefficients_.size() - 1; k-- > 0;) {
    slope = sum + (s - nodes_[k]) * slope;
    sum = coefficients_[k] + (s - nodes_[k]) * sum;
  }
  return slope;
}

}  // namespace pliant::solvers
