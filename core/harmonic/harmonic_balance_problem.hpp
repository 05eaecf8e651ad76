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

/// What solving has cost so far: counts and wall-clock seconds of the parts that no method can do without.
struct SolutionCost {
  int evaluations = 0;  ///< of ∇E at all samples, with or without the Hessians
  int factorizations = 0;
  int solves = 0;  ///< with the factors, a right-hand side each
  double evaluationSeconds = 0;
  double factorizationSeconds = 0;
  double solveSeconds = 0;

  double seconds() const { return evaluationSeconds + factorizationSeconds + solveSeconds; }
};

/// Motions that the Jacobian's stresses are extrapolated from and to (ElasticAssembler::StressSource), with the
/// fractions of the drive that belong to them.
struct StressSource {
  Vector from;
  Vector to;
  double fromFraction = 1;
  double toFraction = 1;
};

/// The periodic motions of a model as roots of h(z, ω) = 0 (thesis 2.3.8).
///
/// z holds the Fourier coefficients of the free coordinates' positions [m]: (2H+1) x nFree, column after column, so the
/// coefficients of one coordinate stand together (constant, sin τ, cos τ, sin 2τ, ...). Prescribed nodes are
/// eliminated: they enter with their exact samples. h is laid out alike and is in newtons:
///   h = (ω² d² ⊗ M + D_α ω d ⊗ M) z + (1 + D_β ω d) ĝ − f̂
/// with d the derivative over τ and ĝ, f̂ the coefficients of ∇E and of the external force. Motions that repeat only
/// after ν periods of the drive (`drivePeriods`) are series in τ = ωt/ν, ω being the frequency of the drive all the
/// same: in the formula, ω/ν stands for ω. Mass and damping that couple
/// free to prescribed coordinates are included.
///
/// Of two driving frequencies without a common period, z holds the coefficients of their combinations and N samples of
/// the torus of their phases are taken (HarmonicBasis::ofTwoFrequencies); ω is the first frequency and ω d multiplies
/// by each combination's. τ from 0 to 2π takes `drivePeriods` periods of the first one, after which nothing repeats.
///
/// Coordinates may have fewer harmonics than the basis (`coordinateHarmonics`): the coefficients of those left out stay
/// zero, and so do their equations. ∂h/∂z is then of the `unknowns` alone, which `restricted` takes out of a vector and
/// `expanded` puts back.
///
/// Threads: `residual`, `linearize` and `parameterDerivative` use working memory of the object, so one thread at a time
/// may call them; all other const members may be called from any thread meanwhile. A copy has working memory of its
/// own.
class HarmonicBalanceProblem {
 public:
  /// `coordinateHarmonics`: 1 to H for each free coordinate; empty: H for all. A basis of two frequencies says itself
  /// how many periods τ takes. Throws base::InputError if the model has a second frequency and the basis has not.
  HarmonicBalanceProblem(std::shared_ptr<const Model> model, math::HarmonicBasis basis, int drivePeriods = 1,
                         std::vector<int> coordinateHarmonics = {});
  HarmonicBalanceProblem(const HarmonicBalanceProblem& other);
  HarmonicBalanceProblem(HarmonicBalanceProblem&&) noexcept;
  HarmonicBalanceProblem& operator=(HarmonicBalanceProblem other) noexcept;
  ~HarmonicBalanceProblem();

  const Model& model() const;
  std::shared_ptr<const Model> sharedModel() const;
  const math::HarmonicBasis& basis() const;
  const mechanics::ElasticAssembler& assembler() const;
  /// ν: periods of the drive, or of its first frequency, that τ from 0 to 2π takes.
  int drivePeriods() const;
  /// Phases of the drive at τ, and at a sample.
  math::Phases phasesAt(double tau) const;
  math::Phases samplePhases(int sample) const;
  /// The same problem for motions that repeat after `drivePeriods` periods of the drive, with harmonics and samples in
  /// proportion; `stretched` gives this problem's motions as its.
  HarmonicBalanceProblem withDrivePeriods(int drivePeriods) const;
  Vector stretched(const Vector& z, int drivePeriods) const;
  /// Number of coefficients, (2H+1) nFree.
  Eigen::Index size() const;
  /// Harmonics of each free coordinate.
  const std::vector<int>& coordinateHarmonics() const;
  /// Number of unknowns: of coefficients that are not left out.
  Eigen::Index unknownCount() const;
  /// The rows of `x` (size() x m) that belong to unknowns; and back, with zeros for the rest.
  Matrix restricted(const Matrix& x) const;
  Matrix expanded(const Matrix& x) const;
  /// `z` with zeros for the coefficients that are left out.
  Vector withoutLeftOut(Vector z) const;

  /// M of the free coordinates, nFree square [kg].
  const SparseMatrix& freeMass() const;

  /// The rest position as coefficients.
  Vector restCoefficients() const;
  /// The force scale [N] that residual norms are divided by: √(‖f̂‖² + (ω² a ‖m‖)²) with f̂ the coefficients of the loads
  /// (gravity included), a the largest swing of a driven coordinate about its mean place and m the masses of the free
  /// coordinates. 1 if there is neither a load nor a drive.
  double forceScale(double omega) const;

  /// Loads and drives are split into a steady part (gravity, the mean of the loads, each drive at that sample of its
  /// motion that is nearest to the mean) and the rest, of which there is `fraction`: of the loads, and of each drive's
  /// signal, so that what turns stays rigid. For ramping the drive up.
  void setDriveFraction(double fraction);
  double driveFraction() const { return driveFraction_; }

  /// Positions of all coordinates with the free ones at rest and the prescribed ones at their steady place [m].
  const Vector& steadyConfiguration() const;
  /// The steady part of the external force on all coordinates [N].
  const Vector& steadyForce() const;
  /// Coefficients of a motionless configuration (of all coordinates).
  Vector constantCoefficients(const Vector& configuration) const;
  /// The coefficients with their constants set to zero: the swing about the mean position.
  Vector oscillation(const Vector& z) const;

  /// h(z, ω), size().
  Vector residual(const Vector& z, double omega) const;
  /// h, ∂h/∂z (unknownCount() square, pattern constant) and ∂h/∂ω at once; null outputs are not computed. ∂h/∂z is
  /// exact unless `stresses` are given: with those of a better motion it makes a better step from a prediction or a
  /// Newton iterate than its own.
  void linearize(const Vector& z, double omega, Vector& h, SparseMatrix* jacobian, Vector* frequencyDerivative,
                 const StressSource* stresses = nullptr) const;
  /// ∂h/∂p, size(): with all of the drive, and with the coordinates that are not free moving as p moves them.
  Vector parameterDerivative(const Vector& z, double omega, const mechanics::DesignParameter& parameter) const;
  Vector parameterDerivative(const Vector& z, double omega, const mechanics::ModelDerivative& change) const;

  /// Positions of every coordinate at the N samples: N x coordinates [m].
  Matrix trajectories(const Vector& z) const;
  /// Positions of one node at the N samples: N x dimension [m].
  Matrix nodeTrajectory(const Vector& z, int node) const;
  /// Positions of every coordinate at any τ [m].
  Vector configurationAt(const Vector& z, double tau) const;
  /// The coefficients with another number of harmonics (cut or filled with zeros).
  static Vector changeHarmonics(const Vector& z, int fromHarmonics, int toHarmonics);

  /// What this object's evaluations, and the solvers that use it, have cost.
  SolutionCost& cost() const;

 private:
  struct Structure;
  struct Workspace;

  void evaluate(const Vector& z, bool withHessian, const StressSource* stresses = nullptr) const;
  void samplePositions(const Vector& z, double fraction, Matrix& positions) const;
  Matrix inertialCoefficients(const Vector& z, const SparseMatrix& massToFree) const;

  std::shared_ptr<const Structure> structure_;
  std::unique_ptr<Workspace> workspace_;
  double driveFraction_ = 1;
};

}  // namespace pliant::harmonic
