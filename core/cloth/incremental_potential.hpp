#pragma once

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/cloth/wind_drag.hpp"
#include "core/math/block_cholesky.hpp"

namespace pliant::cloth {

using mechanics::Vector;

/// What one implicit step knows of the past. Velocities are v(x) = rate (x - base); a step ends where
///   M rate (v - v̄) = f - ∇E(x) - D_α M v - D_β rate (∇E(x) - history) + wind(v),   target = base + v̄ / rate.
/// Implicit Euler over h: rate 1/h, base x₀, v̄ = v₀, history ∇E(x₀). BDF-2 (over equal steps): rate 3/(2h),
/// base (4 x₀ - x₋₁)/3, and v̄ and history alike.
struct StepTerms {
  double rate = 0;  ///< [1/s]
  Vector base;      ///< [m]
  Vector target;    ///< where inertia alone would lead [m]
  Vector history;   ///< earlier elastic forces [N]; may be empty without stiffness-proportional damping
};

struct NewtonOptions {
  /// Root mean square (by mass) of the distance by which the unbalanced force would move the nodes in the step,
  /// relative to the size of the model.
  double tolerance = 1e-8;
  int maximumIterations = 100;
};

/// The function whose minimum is an implicit step:
///   Φ(x) = ½ rate² ‖x - target‖²_M + ½ D_α rate ‖x - base‖²_M + (1 + D_β rate) E(x) - D_β rate history·x - f·x
///          + ψ(v(x)) / rate,
/// over the coordinates of the nodes that are not held; ψ is the wind's (WindDrag).
class IncrementalPotential {
 public:
  explicit IncrementalPotential(std::shared_ptr<const ClothProblem> problem);

  /// Which nodes are held from now on; the symbolic factorisation is made anew if that changed anything.
  void setHeld(const std::vector<char>& held);
  const std::vector<char>& held() const { return held_; }

  void setTerms(StepTerms terms) { terms_ = std::move(terms); }
  const StepTerms& terms() const { return terms_; }
  /// A constant force besides gravity [N], or empty: what stands for limits in a drape.
  void setExtraForce(Vector force) { extraForce_ = std::move(force); }
  /// Normals and air of the step, see WindDrag::begin.
  void beginWind(const Eigen::Matrix3Xd& positions, double time);

  /// [J] and [N]; x and the gradient are over all coordinates, the gradient 0 where nodes are held.
  double value(const Vector& x) const;
  Vector gradient(const Vector& x) const;

  /// Moves the free nodes of `x` to the minimum by Newton's method with line search. The report's residual is what
  /// NewtonOptions::tolerance bounds.
  base::SolverReport minimize(Vector& x, const NewtonOptions& options, base::ExecutionContext& context);

  /// A step of Newton's method from x, on all coordinates. Where compression or sharp bends make the Hessian
  /// indefinite it takes the convex one (see mechanics::HessianKind), and if that is not enough, more inertia. False
  /// if none lowers Φ.
  bool newtonStep(const Vector& x, const Vector& gradient, Vector& step);
  /// Of the Hessian of the last step: the entries other than those of inertia, in the order of the assembler's [N/m],
  /// and by how much M counts [1/s²].
  const Vector& hessianEntries() const { return entries_; }
  double inertia() const {
    return (1 + shift_) * terms_.rate * terms_.rate + problem_->model->massDamping * terms_.rate;
  }
  const std::vector<int>& hessianRows() const { return assembler_.rows(); }
  const std::vector<int>& hessianColumns() const { return assembler_.columns(); }

  /// ∇E on all coordinates, held ones included [N].
  Vector elasticForce(const Vector& x) const { return assembler_.gradient(x); }
  const Vector& externalForce() const { return externalForce_; }
  /// Of the air on a cloth at rest, with normals as in beginWind [N].
  Vector windForce() const;
  /// Per coordinate [kg].
  const Vector& masses() const { return masses_; }
  /// The diagonal of the box around the rest shape [m].
  double size() const { return size_; }

 private:
  double residualOf(const Vector& gradient) const;
  /// The convex Hessian is stiffer than the exact one: doubles its step as long as that lowers Φ, which is `energy` at
  /// x. Returns how many steps that is.
  double longestDescent(const Vector& x, const Vector& step, double energy) const;
  void evaluateHessian(const Vector& x, mechanics::HessianKind kind);
  /// The factors of the Hessian last evaluated; false if it is not positive definite.
  bool factorize();

  std::shared_ptr<const ClothProblem> problem_;
  mechanics::ElasticAssembler assembler_;  ///< of the model with all its coordinates free
  std::optional<WindDrag> wind_;
  Vector masses_, externalForce_;
  double size_ = 0;
  double totalMass_ = 0;
  StepTerms terms_;
  Vector extraForce_;
  std::vector<char> held_;
  std::vector<int> free_;  ///< nodes
  std::optional<math::BlockCholesky> cholesky_;
  std::vector<Eigen::Index> slots_;                     ///< of each entry of the assembler in the factors, -1: held
  std::vector<std::array<Eigen::Index, 3>> diagonals_;  ///< of each free node
  Vector entries_;                                      ///< the Hessian of the last step, without mass
  bool convex_ = false;                                 ///< whether the last step took the convex Hessian
  int convexSteps_ = 0;                                 ///< for which the exact Hessian is not tried
  double shift_ = 0;                                    ///< of inertia, that the last factorisation needed
};

}  // namespace pliant::cloth
