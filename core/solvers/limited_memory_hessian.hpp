#pragma once

#include <Eigen/Core>

namespace pliant::solvers {

/// The BFGS approximation of a Hessian from the last few changes of the variables and gradients, in the compact form
///   B = θ I - W M Wᵀ,  W = [Y, θ S],  M = [-D, Lᵀ; L, θ SᵀS]⁻¹  (Byrd, Lu, Nocedal & Zhu 1995, 3.2-3.4),
/// positive definite.
class LimitedMemoryHessian {
 public:
  LimitedMemoryHessian(Eigen::Index variables, int memory, double theta)
      : memory_(memory), theta_(theta), w_(variables, 0) {}

  double theta() const { return theta_; }
  /// n x 2m, m corrections.
  const Eigen::MatrixXd& w() const { return w_; }
  bool empty() const { return w_.cols() == 0; }
  /// M v.
  Eigen::VectorXd timesM(const Eigen::VectorXd& v) const { return m_ * v; }
  const Eigen::MatrixXd& m() const { return m_; }

  /// Takes the change `s` of the variables and `y` of the gradient in, unless their product is not clearly positive.
  void update(const Eigen::VectorXd& s, const Eigen::VectorXd& y);
  void forget(double theta);

 private:
  int memory_;
  double theta_;
  Eigen::MatrixXd s_, y_;
  Eigen::MatrixXd w_, m_;
};

}  // namespace pliant::solvers
