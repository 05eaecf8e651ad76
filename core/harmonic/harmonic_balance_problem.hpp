#pragma once

#include <memory>

#include "core/math/harmonic_basis.hpp"
#include "core/math/sparse_factorization.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/model.hpp"

namespace pliant::harmonic {

using mechanics::Matrix;
using mechanics::Model;
using mechanics::SparseMatrix;
using mechanics::Vector;

/// The periodic motions of a model as roots of h(z, ω) = 0 (thesis 2.3.8).
///
/// z holds the Fourier coefficients of the free coordinates' positions [m]: (2H+1) x nFree, column after column, so the
/// coefficients of one coordinate stand together (constant, sin τ, cos τ, sin 2τ, ...). Prescribed nodes are
/// eliminated: they enter with their exact samples. h is laid out alike and is in newtons:
///   h = (ω² d² ⊗ M + D_α ω d ⊗ M) z + (1 + D_β ω d) ĝ − f̂
/// with d the derivative over τ and ĝ, f̂ the coefficients of ∇E and of the external force.
class HarmonicBalanceProblem {
 public:
  HarmonicBalanceProblem(std::shared_ptr<const Model> model, math::HarmonicBasis basis);

  const Model& model() const { return *model_; }
  std::shared_ptr<const Model> sharedModel() const { return model_; }
  const math::HarmonicBasis& basis() const { return basis_; }
  /// Number of unknowns, (2H+1) nFree.
  Eigen::Index size() const;

  /// The rest position as coefficients.
  Vector restCoefficients() const;
  /// A force scale [N] that residual norms are divided by: the norm of the external and inertial forces of the drive.
  double forceScale(double omega) const;

  /// The same problem with drives and loads (all but gravity) scaled by `fraction`: for ramping the drive up.
  void setDriveFraction(double fraction);

  /// h(z, ω), size().
  Vector residual(const Vector& z, double omega) const;
  /// h, ∂h/∂z (pattern constant) and ∂h/∂ω at once; null outputs are not computed.
  void linearize(const Vector& z, double omega, Vector& h, SparseMatrix* jacobian, Vector* frequencyDerivative) const;
  /// ∂h/∂p, size().
  Vector parameterDerivative(const Vector& z, double omega, const mechanics::DesignParameter& parameter) const;

  /// Positions of every coordinate at the N samples: N x (n * dimension) [m].
  Matrix trajectories(const Vector& z) const;
  /// Positions of every coordinate at any τ, size n * dimension [m].
  Vector configurationAt(const Vector& z, double tau) const;
  /// The coefficients with another number of harmonics (cut or filled with zeros).
  static Vector changeHarmonics(const Vector& z, int fromHarmonics, int toHarmonics);

 private:
  struct Cache;
  std::shared_ptr<const Model> model_;
  math::HarmonicBasis basis_;
  std::shared_ptr<Cache> cache_;
};

}  // namespace pliant::harmonic
