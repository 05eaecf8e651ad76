#pragma once

#include <Eigen/Core>
#include <vector>

namespace pliant::solvers {

/// The polynomial of lowest degree that has given values and derivatives at given parameters (divided differences with
/// doubled nodes): a cubic through two points, a quintic through three.
class HermiteCurve {
 public:
  /// Adds a point with its derivative at the parameter `s`, different from the others'.
  void add(double s, const Eigen::VectorXd& value, const Eigen::VectorXd& derivative);

  Eigen::VectorXd value(double s) const;
  Eigen::VectorXd derivative(double s) const;

 private:
  std::vector<double> nodes_;
  std::vector<Eigen::VectorXd> lastDifferences_;  ///< the newest diagonal of the table, lowest order first
  std::vector<Eigen::VectorXd> coefficients_;     ///< of Newton's form
};

}  // namespace pliant::solvers
