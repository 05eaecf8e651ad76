#pragma once

#include <memory>
#include <optional>

#include "core/harmonic/inverse_design.hpp"
#include "core/harmonic/jacobian_solver.hpp"
#include "core/harmonic/parameter_jacobian.hpp"
#include "core/mechanics/joint_parameter.hpp"

namespace pliant::harmonic {

/// A design with its motion. Copies are cheap but for the motion.
struct DesignPoint {
  Vector variables;  ///< 0 to 1 between the bounds
  std::shared_ptr<const HarmonicBalanceProblem> problem;
  PeriodicMotion motion;                                  ///< its factors may be those of a design before
  std::shared_ptr<const ParameterJacobian> byParameters;  ///< ∂h/∂p
};

/// The branch of motions over the design parameters, followed from one design to another.
class DesignBranch {
 public:
  DesignBranch(const HarmonicBalanceProblem& first, const InverseDesignOptions& options,
               base::ExecutionContext& context);

  const Vector& ranges() const { return ranges_; }
  /// The first design's variables.
  Vector firstVariables() const;
  /// Parameters of some variables.
  Vector valuesOf(const Vector& variables) const { return lower_ + ranges_.cwiseProduct(variables); }

  /// The first design with its motion.
  DesignPoint begin();
  /// The first design with a motion that is known: coefficients `z` that solve its equations.
  DesignPoint beginAt(const Vector& z);
  /// Goes from a design that is known towards another; false if the branch does not lead there. `point` is the last
  /// design reached either way.
  bool follow(DesignPoint& point, const Vector& variables);

  int solves() const { return solves_; }
  SolutionCost cost() const { return cost_; }

 private:
  double omegaOf(const HarmonicBalanceProblem& problem) const;
  std::optional<DesignPoint> tryStep(const DesignPoint& from, const Vector& variables);
  bool correct(DesignPoint& point, const DesignPoint& from, double swing);
  bool correctByNewton(DesignPoint& point, StressSource stresses);
  bool correctWithOldFactors(DesignPoint& point, double swing);
  void complete(DesignPoint& point) const;
  void addCost(const SolutionCost& cost);

  HarmonicBalanceProblem first_;
  std::vector<int> indices_;
  const InverseDesignOptions& options_;
  base::ExecutionContext& context_;
  std::vector<std::shared_ptr<const mechanics::DesignParameter>> parameters_;
  Vector lower_, ranges_;
  int sign_ = 0;  ///< of det ∂h/∂z at the first design
  int solves_ = 0;
  SolutionCost cost_;
};

}  // namespace pliant::harmonic
