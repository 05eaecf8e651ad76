#include "core/harmonic/linear_modes.hpp"

#include <Spectra/SymGEigsSolver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"

namespace pliant::harmonic {

namespace {

using base::TerminationType;

/// Up to here all modes are computed by dense matrices, in less time than a Lanczos iteration takes to set up.
constexpr int largestDenseSize = 200;
/// A mode with ν below this fraction of the largest has no inertia: rounding alone keeps it from ν = 0.
constexpr double smallestInertia = 1e-14;

struct LanczosCancelled {};

/// x -> M x, for Spectra.
class MassProduct {
 public:
  using Scalar = double;
  MassProduct(const SparseMatrix& mass, base::ExecutionContext& context) : mass_(mass), context_(context) {}
  Eigen::Index rows() const { return mass_.rows(); }
  Eigen::Index cols() const { return mass_.cols(); }
  void perform_op(const double* x, double* y) const {
    if (context_.cancelRequested()) throw LanczosCancelled{};
    Eigen::Map<Vector>(y, rows()).noalias() = mass_ * Eigen::Map<const Vector>(x, rows());
  }

 private:
  const SparseMatrix& mass_;
  base::ExecutionContext& context_;
};

/// x -> K x and K⁻¹ x, for Spectra.
class StiffnessProduct {
 public:
  using Scalar = double;
  StiffnessProduct(const SparseMatrix& stiffness, const math::SparseFactorization& factors)
      : stiffness_(stiffness), factors_(factors) {}
  Eigen::Index rows() const { return stiffness_.rows(); }
  Eigen::Index cols() const { return stiffness_.cols(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Vector>(y, rows()).noalias() = stiffness_ * Eigen::Map<const Vector>(x, rows());
  }
  void solve(const double* x, double* y) const {
    Eigen::Map<Vector>(y, rows()) = factors_.solve(Eigen::Map<const Vector>(x, rows())).col(0);
  }

 private:
  const SparseMatrix& stiffness_;
  const math::SparseFactorization& factors_;
};

class ModalAnalysis {
 public:
  ModalAnalysis(const HarmonicBalanceProblem& problem, const LinearModesOptions& options,
                base::ExecutionContext& context)
      : model_(problem.model()),
        options_(options),
        context_(context),
        system_(linearizeAtEquilibrium(problem, context)),
        size_(static_cast<int>(system_.stiffness.rows())) {}

  LinearModes run() {
    const base::Stopwatch watch;
    result_.equilibrium = system_.equilibrium;
    result_.report = system_.report;
    result_.report.iterations.clear();
    if (result_.report.converged()) solve();
    result_.report.seconds = watch.seconds();
    return std::move(result_);
  }

 private:
  void solve() {
    if (!factors_.factorize(system_.stiffness)) return fail("The stiffness of the structure is singular.");
    const int wanted = std::min(options_.count, size_);
    if (size_ <= largestDenseSize || 2 * wanted + 20 > size_)
      solveDensely(wanted);
    else
      solveByLanczos(wanted);
    std::sort(result_.modes.begin(), result_.modes.end(),
              [](const LinearMode& a, const LinearMode& b) { return a.omega < b.omega; });
    for (const LinearMode& mode : result_.modes)
      result_.report.iterations.push_back({static_cast<int>(result_.report.iterations.size()), mode.residual, 1, 0});
  }

  void solveDensely(int wanted) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver{Matrix(system_.mass), Matrix(system_.stiffness)};
    if (solver.info() != Eigen::Success) return fail("The eigenvalue problem could not be solved.");
    for (int i = 0; i < wanted; ++i)
      addMode(solver.eigenvalues()[size_ - 1 - i], solver.eigenvalues()[size_ - 1],
              solver.eigenvectors().col(size_ - 1 - i));
  }

  void solveByLanczos(int wanted) {
    MassProduct mass(system_.mass, context_);
    StiffnessProduct stiffness(system_.stiffness, factors_);
    Spectra::SymGEigsSolver<MassProduct, StiffnessProduct, Spectra::GEigsMode::RegularInverse> solver(
        mass, stiffness, wanted, 2 * wanted + 20);
    Vector start(size_);
    for (int i = 0; i < size_; ++i) start[i] = 1 + 0.5 * std::sin(1.0 + i);  // no symmetry that a mode could have
    start = factors_.solve(system_.mass * start).col(0);
    if (!(start.norm() > 0)) return;
    try {
      solver.init(start.data());
      solver.compute(Spectra::SortRule::LargestAlge, options_.maximumIterations, options_.tolerance);
    } catch (const LanczosCancelled&) {
      result_.report.termination = TerminationType::cancelled;
      result_.report.message = "The modal analysis was cancelled.";
      return;
    }
    const Vector values = solver.eigenvalues();
    const Matrix vectors = solver.eigenvectors();
    for (Eigen::Index i = 0; i < values.size(); ++i) addMode(values[i], values[0], vectors.col(i));
    if (solver.info() != Spectra::CompInfo::Successful) {
      result_.report.termination = TerminationType::iterationLimit;
      result_.report.message = "Lanczos' method found " + std::to_string(values.size()) + " of " +
                               std::to_string(wanted) + " modes within its iteration limit.";
    } else if (!result_.modes.empty()) {
      checkNoneMissed();
    }
  }

  /// Skips modes without inertia. `inverse` and `largest`: 1/ω² of this mode and of the lowest.
  void addMode(double inverse, double largest, const Vector& vector) {
    if (!(inverse > smallestInertia * largest)) return;
    const double inertia = vector.dot(system_.mass * vector);
    LinearMode mode;
    mode.shape = vector / std::sqrt(inertia);
    const Vector elastic = system_.stiffness * mode.shape;
    const double squared = mode.shape.dot(elastic);  // Rayleigh's quotient
    const Vector defect = system_.mass * mode.shape - elastic / squared;
    const double bound = defect.dot(factors_.solve(defect).col(0));
    mode.residual = std::sqrt(std::max(0.0, bound) * squared);
    mode.omega = std::sqrt(squared);
    mode.dampingRatio = 0.5 * (model_.massDamping / mode.omega + model_.stiffnessDamping * mode.omega);
    Eigen::Index largestEntry = 0;
    mode.shape.cwiseAbs().maxCoeff(&largestEntry);
    if (mode.shape[largestEntry] < 0) mode.shape = -mode.shape;
    result_.modes.push_back(std::move(mode));
  }

  void checkNoneMissed() {
    double highest = 0;
    for (const LinearMode& mode : result_.modes) highest = std::max(highest, mode.omega);
    const double bound = (1 - 1e-6) * highest * highest;
    int below = 0;
    for (const LinearMode& mode : result_.modes) below += mode.omega * mode.omega < bound;
    const int expected = countNegativeEigenvalues(system_.stiffness - bound * system_.mass);
    if (expected >= 0 && expected != below)
      fail("Of " + std::to_string(expected) + " modes below " + std::to_string(std::sqrt(bound)) + " rad/s only " +
           std::to_string(below) + " were found.");
  }

  void fail(std::string message) {
    result_.report.termination = TerminationType::failed;
    result_.report.message = std::move(message);
  }

  const Model& model_;
  const LinearModesOptions& options_;
  base::ExecutionContext& context_;
  Linearization system_;
  int size_;
  math::SparseFactorization factors_;
  LinearModes result_;
};

}  // namespace

LinearModes computeLinearModes(const HarmonicBalanceProblem& problem, const LinearModesOptions& options,
                               base::ExecutionContext& context) {
  return ModalAnalysis(problem, options, context).run();
}

}  // namespace pliant::harmonic
