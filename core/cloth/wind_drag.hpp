#pragma once

#include "core/cloth/cloth_problem.hpp"
#include "core/mechanics/elastic_assembler.hpp"

namespace pliant::cloth {

/// The drag of Wind over one step as a convex function of the velocity: with normals n and areas A as they are at the
/// step's start, the force ½ ρ c A |u| u n, u = (w - v)·n, is minus the derivative by v of
///   ψ(v) = Σ ρ c A |u|³ / 6,
/// so that taken at the end of the step it is dissipative in the air's frame and stable at any step.
class WindDrag {
 public:
  /// `triangles` of the cloth; `assembler` has every coordinate free and every triangle in its pattern.
  WindDrag(Wind wind, std::vector<std::array<int, 3>> triangles, const mechanics::ElasticAssembler& assembler);

  /// Takes normals and areas from `positions` (3 x nodes), and the air's velocity at `time`.
  void begin(const Eigen::Matrix3Xd& positions, double time);

  /// ψ [J/s] of the velocities (all coordinates).
  double value(const mechanics::Vector& velocities) const;
  /// Adds factor ∂ψ/∂v to `gradient`.
  void addGradient(const mechanics::Vector& velocities, double factor, mechanics::Vector& gradient) const;
  /// Adds factor ∂²ψ/∂v² to the assembler's `entries`.
  void addHessian(const mechanics::Vector& velocities, double factor, mechanics::Vector& entries) const;

 private:
  /// Of the air against the triangle, along its normal [m/s].
  double relativeSpeed(std::size_t triangle, const mechanics::Vector& velocities) const;

  Wind wind_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::array<int, mechanics::packedSize(9)>> entries_;  ///< of the assembler, per packed lower triangle
  Eigen::Matrix3Xd normals_;
  Eigen::VectorXd strengths_;  ///< ρ c A [kg/m]
  Eigen::Vector3d air_ = Eigen::Vector3d::Zero();
};

}  // namespace pliant::cloth
