#pragma once

#include "core/cloth/cloth_simulation.hpp"

namespace pliant::cloth {

struct DrapeOptions {
  /// Of the force that neither elasticity nor limits balance, relative to the external force.
  double tolerance = 1e-4;
  double timeStep = 0.05;            ///< h at the start; it adapts itself [s]
  double time = 0;                   ///< at which pins and bodies are taken from their paths [s]
  std::string limitMethod = "cone";  ///< of makeStrainLimiter, or "none"
  ProjectionOptions projection;
  NewtonOptions newton;
};

struct DrapeRecord {
  double residual = 0;  ///< relative: see DrapeOptions::tolerance
  double timeStep = 0;  ///< h [s]
  StepRecord step;      ///< its time is 0
};

/// The static equilibrium of a cloth with limits: positions x that minimise E(x) - f·x among those that keep the
/// limits, where forces R of the limits balance the rest, ∇E(x) - f + R = 0.
///
/// With cone projections and without contact, by Newton's method: each step projects the point to which Newton's method
/// for E(x) - f·x + ‖x - x_k‖²_M / (2h²) would go onto the limits, not by mass but in the norm of that function's
/// Hessian. This is its quadratic model's minimum within the limits, which are convex, so every point on the way there
/// keeps them and a line search decides how far to go; h grows as long as whole steps lower the energy. Compression
/// makes the Hessian indefinite, so as a rule it is the convex one (mechanics::HessianKind), with which steps are too
/// short where folds rearrange themselves; they gain momentum then (Nesterov 1983), which is lost where it does not
/// lower the energy.
///
/// Otherwise by splitting: each step
///   x̃ = argmin E(x) - f·x + R_k·x + ‖x - x_k‖²_M / (2h²),  x_{k+1} = P(x̃ + h² M⁻¹ R_k),
///   R_{k+1} = R_k + M (x̃ - x_{k+1}) / h²
/// is a projected implicit Euler step without inertia that already knows the limits' forces (the alternating direction
/// method of multipliers; Gabay & Mercier 1976, Boyd et al. 2011). Stepping and projecting alone ends where the elastic
/// force of the *candidate* balances the limits, which is no equilibrium unless h is tiny; this ends at one for any h,
/// and h only decides how fast: it is adapted so that the two parts of the unbalanced force,
/// ∇E(x_{k+1}) - ∇E(x̃) and M (x_{k+1} - x_k) / h², stay alike, but not
/// in every step, lest it never settle. The projection is by mass. Contact with bodies and with itself is kept as in
/// ClothSimulation, by the projection; its forces are then part of R.
class ClothDrape {
 public:
  /// Starts from the rest positions. Throws base::InputError as ClothSimulation does.
  ClothDrape(std::shared_ptr<const ClothProblem> problem, DrapeOptions options, LimiterFactory makeLimiter = {});

  /// One step; a step that fails leaves the positions as they were.
  DrapeRecord step(base::ExecutionContext& context);
  bool converged() const { return residual_ <= options_.tolerance; }

  const Eigen::Matrix3Xd& positions() const { return positions_; }
  /// R of every node, contact included, 0 where it is held (3 x nodes) [N].
  const Eigen::Matrix3Xd& limitForces() const { return limitForces_; }
  /// h [s]; the multipliers of the last projection are R's over h².
  double timeStep() const { return timeStep_; }

 private:
  DrapeRecord newtonStep(base::ExecutionContext& context);
  DrapeRecord splitStep(base::ExecutionContext& context);
  StepTerms termsFrom(const Vector& x) const;  ///< at rest there
  /// The part of the last step that is gone once more, before Newton's method takes over (Nesterov 1983): more from
  /// step to step, until it starts anew.
  double momentum();
  void restart() { weight_ = 1; }
  double norm(const Vector& force) const;  ///< over the nodes that are not held
  solvers::ConeSolution project(const Eigen::Matrix3Xd& candidate, base::ExecutionContext& context);

  std::shared_ptr<const ClothProblem> problem_;
  DrapeOptions options_;
  IncrementalPotential potential_;
  LimitedSheet sheet_;
  std::unique_ptr<StrainLimiter> limiter_;
  std::unique_ptr<solvers::ConeProgram> program_;         ///< of Newton's method; stands for the limiter
  std::shared_ptr<mechanics::ContactBarrier> contact_;    ///< null without bodies and self-contact
  std::unique_ptr<ContactProjection> contactProjection_;  ///< stands for the limiter where there is contact
  Eigen::Matrix3Xd positions_, limitForces_;
  double timeStep_;
  double longestStep_ = 1e4;
  Vector previous_;      ///< positions before the last step
  double weight_ = 1;    ///< Nesterov's t: of the momentum
  int sinceChange_ = 0;  ///< steps since h was changed
  double bestResidual_ = std::numeric_limits<double>::infinity();
  int sinceProgress_ = 0;  ///< steps since that was reached
  double residual_ = std::numeric_limits<double>::infinity();
};

}  // namespace pliant::cloth
