#pragma once

#include <optional>

#include "core/interlock/macro_simulation.hpp"

namespace pliant::interlock {

/// Nodes that are moved along a path, turning about the mean of where they start; let go at `release` [s].
struct MacroGrip {
  std::vector<int> nodes;
  std::vector<mechanics::Keyframe> path;
  std::optional<double> release;
};

struct MacroMotionOptions {
  double timeStep = 0.01;  ///< [s]
  double damping = 0;      ///< the force -damping · mass · velocity acts on every node [1/s]
  /// Coefficient of the limits' barrier: as an energy, this much of the work that the loads could do over the size of
  /// the sheet.
  double barrier = 1e-2;
  double tolerance = 1e-6;      ///< see EnergyMinimizerOptions
  int maximumIterations = 200;  ///< of a step
};

struct MacroEnergies {
  double kinetic = 0, elastic = 0;  ///< [J]
  double potential = 0;             ///< of the loads, 0 at the start [J]
  double limits = 0, contact = 0;   ///< of the barriers [J]
  double dissipated = 0;            ///< by friction since the start, not part of the total [J]
  double total() const { return kinetic + elastic + potential + limits + contact; }
};

/// A sheet in motion by implicit Euler: each step is the minimum of the energy with inertia, with limits and contact as
/// in an equilibrium, so neither is ever violated. Grips are springs so stiff that the sheet's weight stretches them by
/// 10⁻⁵ of its size; where limits or bodies hold the sheet they stay behind instead of pulling it through, and so do
/// bodies that move against a sheet that cannot give way. Friction is lagged (SheetFrictionSolver): contacts that hold
/// creep, at 10⁻³ of the sheet's size a second at most.
class MacroMotion {
 public:
  /// From `start`, at rest. Throws base::InputError (location empty) as MacroSimulation::equilibrium does, for grips of
  /// nodes that are not there, that are clamped or gripped twice, and for options that make no sense.
  MacroMotion(std::shared_ptr<const MacroSimulation> simulation, MacroLoads loads, std::vector<MacroGrip> grips,
              const Vector& start, const MacroMotionOptions& options);

  MacroMotion(const MacroMotion&) = delete;
  MacroMotion& operator=(const MacroMotion&) = delete;

  double time() const { return time_; }
  const Vector& positions() const { return positions_; }
  const Vector& velocities() const { return velocities_; }
  void setVelocities(const Vector& velocities) { velocities_ = velocities; }
  /// Where the bodies are now (3 x points) [m].
  const Eigen::Matrix3Xd& bodyPoints() const { return bodyPoints_; }
  MacroEnergies energies() const;
  /// How far the farthest gripped node is from where its grip wants it [m].
  double gripLag() const;
  /// How far the farthest point of a body is from where its path wants it [m].
  double bodyLag() const;
  double barrier() const { return barrier_; }

  /// To the next time. Its residual is that of the minimisation. Where this does not come to its end it is done again
  /// with larger barriers first; what has not converged even then is not stepped to.
  MacroState step(base::ExecutionContext& context);
  /// Of where it is now, without a report.
  MacroState judged() const;

 private:
  using Surroundings = solvers::EnergyMinimizer::Surroundings;
  Surroundings surroundingsOfStep() const;
  /// Moves bodies towards their paths as far as nothing is in their way; true if they got there.
  bool moveBodies();
  base::SolverReport minimize(const Surroundings& surroundings, base::ExecutionContext& context);

  std::shared_ptr<const MacroSimulation> simulation_;
  MacroLoads loads_;
  std::vector<MacroGrip> grips_;
  MacroMotionOptions options_;
  Vector start_, force_, positions_, velocities_;
  Eigen::Matrix3Xd bodyPoints_;
  double time_ = 0, barrier_ = 0, gripStiffness_ = 0;
  std::shared_ptr<mechanics::ContactBarrier> contact_;
  solvers::EnergyMinimizer minimizer_;
  std::optional<SheetFrictionSolver> rubbing_;
  SheetFriction friction_;  ///< of the last step
  double dissipated_ = 0;
};

}  // namespace pliant::interlock
