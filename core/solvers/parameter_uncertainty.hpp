#pragma once

#include <Eigen/Core>
#include <vector>

namespace pliant::solvers {

/// How well a least-squares fit determines its parameters, from the linearisation at its end: residuals with
/// independent errors of one unknown standard deviation are taken for granted.
struct ParameterUncertainty {
  int degreesOfFreedom = 0;
  double residualDeviation = 0;  ///< √(Σ r² / degrees of freedom)
  /// √ of the diagonal of s² (JᵀJ)⁻¹; NaN for parameters that are held or not determined.
  Eigen::VectorXd standardErrors;
  /// Half the width of each parameter's own confidence interval: Student's t times the standard error.
  Eigen::VectorXd halfWidths;
  Eigen::MatrixXd correlation;  ///< of the estimates; NaN where there is no standard error, but 1 on the diagonal
  /// Changes of the parameters that together leave the residuals as they are: columns of length n, of any size, 0 for
  /// the held ones.
  Eigen::MatrixXd undetermined;
};

/// `jacobian`: m x n, ∂r/∂p with what else is unknown (`otherUnknowns` of them, such as offsets) projected out;
/// `scales`: the length of a column that counts as 1, such as its length before that (0: the parameter does nothing).
/// `held`: parameters that count as known, since they stand at a bound. Combinations whose singular value in these
/// units is below `rankTolerance` times the largest count as undetermined; so do parameters that take part in one by
/// more than a thousandth. `level`: of the confidence intervals, such as 0.95. Throws std::invalid_argument without a
/// degree of freedom.
ParameterUncertainty parameterUncertainty(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& scales,
                                          const std::vector<char>& held, double sumOfSquares, int otherUnknowns,
                                          double level, double rankTolerance = 1e-6);

}  // namespace pliant::solvers
