#pragma once

#include <functional>
#include <map>

#include "core/cloth/cloth_contact.hpp"
#include "core/cloth/contact_projection.hpp"
#include "core/cloth/incremental_potential.hpp"

namespace pliant::cloth {

/// IE and BDF-2 without limits; SAP, SAR (thesis 3.4, Algorithm 1), their BDF-2 variants BAP and BAR, and a reflection
/// scheme after Narain, Zehnder & Thomaszewski 2019: see ClothSimulation.
enum class SteppingScheme {
  implicitEuler,
  bdf2,
  stepAndProject,
  stepAndReflect,
  bdf2AndProject,
  bdf2AndReflect,
  secondOrderReflect
};

/// Whether a scheme keeps limits.
bool keepsLimits(SteppingScheme scheme);

struct SteppingOptions {
  SteppingScheme scheme = SteppingScheme::stepAndReflect;
  double timeStep = 0.01;            ///< Δt [s]
  std::string limitMethod = "cone";  ///< of makeStrainLimiter, or "none"
  ProjectionNorm norm = ProjectionNorm::mass;
  ProjectionOptions projection;
  NewtonOptions newton;
};

/// A moving cloth at one instant; 3 x nodes [m], [m/s].
struct ClothState {
  double time = 0;
  Eigen::Matrix3Xd positions;
  Eigen::Matrix3Xd velocities;
  /// What BDF-2 needs: the state one (half) step earlier; empty at the start.
  Eigen::Matrix3Xd earlierPositions;
  Eigen::Matrix3Xd earlierVelocities;
};

struct StepRecord {
  double time = 0;  ///< at its end [s]
  Energies energies;
  double violation = 0;  ///< largest stretch over limit - 1, at least 0
  int newtonIterations = 0;
  double newtonSeconds = 0;
  int projections = 0;
  int projectionIterations = 0;
  double projectionSeconds = 0;
  std::shared_ptr<const solvers::ConeSolution> projection;       ///< the last one; null if there was none
  double smallestGap = std::numeric_limits<double>::infinity();  ///< to bodies and itself [m]
  /// converged; iterationLimit: done, but not as exactly as asked; else the state is still that before the step.
  base::TerminationType termination = base::TerminationType::converged;
  std::string message;

  bool done() const {
    return termination == base::TerminationType::converged || termination == base::TerminationType::iterationLimit;
  }
};

using LimiterFactory = std::function<std::unique_ptr<StrainLimiter>(const SheetCones&)>;

/// Steps a cloth through time. With P the projection onto the limits, I_k(x, v) the candidate of an implicit Euler step
/// over k, and h = Δt:
///  - implicitEuler: x₁ = I_h(x₀, v₀), v₁ = (x₁ - x₀)/h. bdf2: the same with BDF-2 after a first step by Euler.
///  - stepAndProject: x₁ = P(I_h(x₀, v₀)), v₁ = (x₁ - x₀)/h.
///  - stepAndReflect (thesis 3.4, Algorithm 1): x̃ = I_{h/2}(x₀, v₀), x = P(x̃), v = (x - x₀)/(h/2), x̂ = 2x - x̃,
///    x₁ = P(I_{h/2}(x̂, v)), v₁ = (x₁ - x̂)/(h/2). The last velocity uses the reflected position; the published
///    listing's other reading gains or loses the reflection as velocity.
///  - bdf2AndProject: BDF-2 in place of Euler, with v₁ = (3x₁ - 4x₀ + x₋₁)/(2h) (English & Bridson 2008). Of second
///    order for smooth motion along the limits.
///  - bdf2AndReflect: BDF-2 over both half steps. A reflection by 2(x - x̃) moves all positions from which the second
///    half step differentiates, or else its velocities would be off by the reflection over h, to first order; the next
///    step differentiates from the projected middle x. (Other choices, among them Algorithm 1 with BDF-2 put in place
///    of Euler as the thesis describes, blow up within half a second on the sheet of Fig. 3.4.)
///  - secondOrderReflect: x̃ = I_{h/2}(x₀, v₀), x = P(x̃), v = (x - x₀)/(h/2): elastic and limit forces as an implicit
///    midpoint rule has them. Reflection about this midpoint, x̂ = 2x - x₀, v̂ = 2v - v₀, applies the same forces once
///    more, and x₁ = P(x̂), v₁ = v̂ + (x₁ - x̂)/(h/2). That reflection and implicit midpoint are one is what Narain,
///    Zehnder & Thomaszewski (2019) found for fluids, whose constraints are linear: there, and for cloth while no limit
///    is active, the scheme is of second order and keeps energy. Stretch limits are curved; along them it is of first
///    order, with an eighth of step-and-project's error for a pendulum at the end of its tether.
/// Wind and damping: see WindDrag and StepTerms.
///
/// With bodies or self-contact P also keeps the cloth from going through them (ContactProjection): the candidate
/// ignores contact, and P starts from x₀, which is free of it. Reflected positions would not be, so the schemes that
/// reflect refuse contact.
class ClothSimulation {
 public:
  /// Starts at rest in the model's rest positions, pins where their paths are at time 0. `makeLimiter` stands in for
  /// makeStrainLimiter where given. Throws base::InputError (location empty) for a problem that checkClothProblem
  /// refuses, an unknown method, a time step or tolerance that is not above 0, or a scheme that needs limits' method
  /// "none" or not.
  ClothSimulation(std::shared_ptr<const ClothProblem> problem, SteppingOptions options,
                  LimiterFactory makeLimiter = {});
  ~ClothSimulation();
  ClothSimulation(ClothSimulation&&) noexcept;

  const ClothProblem& problem() const { return *problem_; }
  const std::shared_ptr<const ClothProblem>& sharedProblem() const { return problem_; }
  const SteppingOptions& options() const { return options_; }
  const ClothState& state() const { return state_; }
  /// Another start; forgets what BDF-2 knows. Throws base::InputError for wrong sizes or numbers that are not finite.
  void setState(double time, const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& velocities);

  /// One step of Δt.
  StepRecord step(base::ExecutionContext& context);

  /// From the next step on `node` is held, and reaches `position` [m] at the step's end; for dragging by hand. Stands
  /// before what a pin says of the node.
  void setPinTarget(int node, const Eigen::Vector3d& position);
  /// Undoes setPinTarget.
  void releasePinTarget(int node);

  Energies energies() const { return energiesAt(*problem_, state_.positions, state_.velocities); }
  /// Of the bodies' points at the state's time, one body after the other [m].
  Eigen::Matrix3Xd bodyPoints() const { return bodyPointsAt(*problem_, state_.time); }

 private:
  struct Attempt;
  void requireFree() const;
  void updateHeld();
  /// All positions with held nodes where they are a fraction of the step after its start.
  Vector withPins(Vector positions, double fraction) const;
  StepTerms eulerTerms(const Vector& x, const Vector& v, double duration) const;
  StepTerms bdf2Terms(const Vector& x, const Vector& v, const Vector& earlierX, const Vector& earlierV,
                      double duration) const;
  bool stepOnce(Attempt& attempt);
  bool stepReflected(Attempt& attempt);
  bool stepSecondOrder(Attempt& attempt);

  std::shared_ptr<const ClothProblem> problem_;
  SteppingOptions options_;
  LimiterFactory makeLimiter_;
  IncrementalPotential potential_;
  LimitedSheet sheet_;  ///< with `fixed` as pins are now
  std::unique_ptr<StrainLimiter> limiter_;
  std::shared_ptr<mechanics::ContactBarrier> contact_;    ///< null without bodies and self-contact
  std::unique_ptr<ContactProjection> contactProjection_;  ///< stands for the limiter where there is contact
  ClothState state_;
  std::map<int, Eigen::Vector3d> targets_;
};

}  // namespace pliant::cloth
