#pragma once

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// The energy of one pair of parts with its derivatives by 15 local coordinates: translation and rotation vector of A,
/// those of B, and the strain.
struct ContactTerms {
  using Vector = Eigen::Matrix<double, 15, 1>;
  using Matrix = Eigen::Matrix<double, 15, 15>;

  double gap = 0;  ///< [m]
  double value = 0;
  double force = 0;  ///< -dE/dgap [1/m]
  Vector gradient;
  Matrix hessian;
  Eigen::Vector3d place;   ///< midway between the surfaces, from A's origin [m]
  Eigen::Vector3d normal;  ///< from B to A
  /// What `compute` was given last.
  const PlacedPart *a = nullptr, *b = nullptr;
  Eigen::Vector3d offset;

  /// False if the gap is not below the range; then nothing is set but the gap. `between` is origin_A - origin_B,
  /// `translation` the lattice vector at rest by which B is moved [m]. Of two parts that overlap only the gap is set.
  bool compute(const PlacedPart& partA, const PlacedPart& partB, const Eigen::Vector3d& between,
               const Eigen::Vector2d& translation, const CellContact::Barrier& barrier, bool wantGradient,
               bool wantHessian);

 private:
  bool computeArcs(const Eigen::Vector2d& translation, const CellContact::Barrier& barrier, bool wantGradient,
                   bool wantHessian);
  bool computeSimplices(const Eigen::Vector2d& translation, const CellContact::Barrier& barrier, bool wantGradient,
                        bool wantHessian);
};

}  // namespace pliant::interlock
