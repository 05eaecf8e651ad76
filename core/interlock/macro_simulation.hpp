#pragma once

#include <limits>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/interlock/sheet_friction.hpp"
#include "core/mechanics/admissible_strain_set.hpp"
#include "core/mechanics/contact_body.hpp"
#include "core/mechanics/strain_limits.hpp"
#include "core/solvers/energy_minimizer.hpp"

namespace pliant::interlock {

using mechanics::Vector;

/// An interlocking material at the scale of large pieces: what strains it can reach, and a weak elastic base that says
/// what it does in between (thesis 4.3.4, whose numbers are the defaults).
struct MacroMaterial {
  std::shared_ptr<const mechanics::AdmissibleStrainSet> stretch;  ///< Green strain; null: no limit
  std::shared_ptr<const mechanics::AdmissibleStrainSet> bending;  ///< curvature [1/m]; null: no limit
  double youngModulus = 1250;                                     ///< [Pa]
  double poissonRatio = 0.4;
  double density = 250;     ///< [kg/m³]
  double thickness = 5e-3;  ///< [m]
};

/// A flat piece, of one material or several.
struct MacroSheet {
  geometry::SurfaceMesh mesh;  ///< at rest in z = 0, counterclockwise from above
  std::vector<MacroMaterial> materials;
  std::vector<int> materialOf;  ///< per triangle; empty: the first
  std::vector<double> angleOf;  ///< of the material's first axis, per triangle [rad]; empty: 0
};

/// What a sheet may not go through.
struct MacroContact {
  std::vector<mechanics::Body> bodies;
  double distance = 1e-3;    ///< gap below which contact begins to push [m]
  bool selfContact = false;  ///< whether the sheet also touches itself
  double friction = 0;       ///< Coulomb's coefficient of all contacts
};

struct MacroLoads {
  Vector force;                                       ///< on all coordinates [N]; empty: none
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s²]
  std::vector<int> clamped;                           ///< nodes that do not move
};

struct MacroOptions {
  mechanics::StrainLimitFunction::Kind limits = mechanics::StrainLimitFunction::Kind::barrier;
  /// Of a barrier: strains keep this far inside, their gauges below 1 - margin, so that elements have room (see
  /// StrainLimitFunction).
  double margin = 0;
  double penalty = 1e7;     ///< c of the penalty [J/m²] (thesis 4.3.5)
  double tolerance = 1e-8;  ///< see EnergyMinimizerOptions
  /// The barrier shrinks until what it could still yield is below this fraction of the work that loads have done.
  double remaining = 1e-5;
  int maximumIterations = 500;  ///< of each barrier
  /// What MacroState::path keeps is this far from each other at least [m]; 0: nothing is kept.
  double pathSpacing = 0;
};

/// The sheet at rest under its loads, and how near its triangles are to their limits.
struct MacroState {
  Vector positions;
  base::SolverReport report;  ///< all iterations; the residual is that of EnergyMinimizer
  mechanics::SheetStrains strains;
  Eigen::VectorXd stretchGauge, bendingGauge;  ///< per triangle: 1 at the limit; 0 without one
  /// Largest distance outside a limit, less the margin, over the size of its set; 0: none is outside.
  double violation = 0;
  double barrier = 0;    ///< the last coefficient [J/m²]; of the penalty its c
  double remaining = 0;  ///< how much lower the energy could be without the barrier's room, to first order [J]
  double work = 0;       ///< of the loads from rest [J]
  /// Between the sheet and bodies and itself [m]; infinite: there is nothing near that it may touch.
  double smallestGap = std::numeric_limits<double>::infinity();
  double supported = 0;    ///< Σ of the forces with which bodies push against the sheet's weight [N]
  SheetFriction friction;  ///< of the last increment or step
  int increments = 0;      ///< in which an equilibrium with friction was found
  /// Positions on the way, the start first and the last not among them: all within the limits, and none through
  /// anything.
  std::vector<Vector> path;
};

/// Static equilibria of a sheet of constant-strain triangles and four-triangle curvatures (Gingold et al.
/// 2004) whose strains stay within their admissible sets and which goes neither through bodies nor through itself. For
/// its motion see MacroMotion.
class MacroSimulation {
 public:
  /// Throws base::InputError (location empty) for a mesh that is not flat, a number that makes no sense, a material
  /// that does not allow for its rest shape, or not with the margin, or a contact distance that is not above 0.
  MacroSimulation(MacroSheet sheet, const MacroOptions& options, MacroContact contact = {});

  const MacroSheet& sheet() const { return sheet_; }
  const std::vector<mechanics::LimitedTriangle>& triangles() const { return triangles_; }
  /// Per node [kg].
  const Vector& masses() const { return masses_; }
  Vector rest() const { return sheet_.mesh.points.reshaped(); }

  /// Static equilibrium, with friction that of a slow motion (FrictionalRest), from `start`, which must be within the
  /// limits where there is a barrier, and free of bodies and of itself; null: from rest. Throws base::InputError
  /// (location empty) if it meets something.
  MacroState equilibrium(const MacroLoads& loads, const Vector* start, base::ExecutionContext& context) const;

 private:
  friend class MacroMotion;
  using Surroundings = solvers::EnergyMinimizer::Surroundings;
  Surroundings surroundingsOf(const MacroLoads& loads) const;
  std::vector<char> held(const MacroLoads& loads) const;
  std::vector<solvers::EnergyMinimizer::Term> terms() const;
  /// A barrier of its own, for positions from where all is free of each other; null: nothing can touch. Throws as
  /// `equilibrium`.
  std::shared_ptr<mechanics::ContactBarrier> contactFrom(const Vector& start, const Eigen::Matrix3Xd& bodyPoints) const;
  void judgeContact(MacroState& state, mechanics::ContactBarrier* contact, const Eigen::Matrix3Xd& bodyPoints,
                    const Eigen::Vector3d& up) const;
  double size() const;
  /// Of the sheet's nodes and the bodies' points, one after the other [m].
  Eigen::Matrix3Xd withBodies(const Vector& positions, const Eigen::Matrix3Xd& bodyPoints) const;
  /// What shrinking the barrier to nothing could yield, to first order: Σ area c g ψ'(g) (1 - g).
  void judge(MacroState& state) const;

  MacroSheet sheet_;
  MacroOptions options_;
  MacroContact contact_;
  std::vector<mechanics::LimitedTriangle> triangles_;
  Vector areas_;   ///< per triangle [m²]
  Vector masses_;  ///< per node [kg]
  std::shared_ptr<const mechanics::ElasticAssembler> elastic_;
  std::shared_ptr<const mechanics::ElasticAssembler> limits_;  ///< with the coefficient 1; null: none
};

}  // namespace pliant::interlock
