#include "core/harmonic/floquet_stability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/harmonic/hill_operator.hpp"
#include "core/solvers/arnoldi.hpp"

namespace pliant::harmonic {

namespace {

using Exponent = std::complex<double>;

constexpr int firstSteps = 16;
constexpr int stepsAtOnce = 8;
constexpr int mostSteps = 200;
/// All exponents this close to zero are found: the strip |Im ρ| <= 1/2, which holds one copy of each, and more.
constexpr double searchRadius = 0.75;
/// Errors of the exponents found, of which the stability must not depend: relative to their modulus, and to the real
/// part whose sign matters.
constexpr double exponentTolerance = 1e-8;
constexpr double realPartTolerance = 1e-3;
constexpr double outsideTolerance = 1e-3;  ///< of the next one beyond: proof that none nearer was missed
/// Exponents with Im ρ = 1/2 (negative multipliers) are only that exact with infinitely many harmonics.
constexpr double stripMargin = 0.01;
/// Of the energy of a disturbance that may be in the highest harmonic for its exponent to count.
constexpr double mostTopEnergy = 0.1;
/// That makes no difference. Above it, copies are looked for that are as near as this energy suggests, so that they are
/// not those of another exponent.
constexpr double goodTopEnergy = 1e-3;
constexpr double copyDistance = 0.05;
constexpr std::size_t multipliersKept = 8;

struct HillExponent {
  Exponent exponent;
  double topEnergy;  ///< share of each coordinate's highest harmonic
};

Vector firstVector(Eigen::Index size) {
  std::mt19937 random(5);
  return Vector::NullaryExpr(size, [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; });
}

double topEnergy(const HarmonicBalanceProblem& problem, const Eigen::VectorXcd& p) {
  const Eigen::Index width = problem.basis().size();
  double top = 0;
  double all = 0;
  for (std::size_t f = 0; f < problem.coordinateHarmonics().size(); ++f) {
    // In terms of e^{ikτ}: half of the squares of sine and cosine, all of the constant's.
    const auto coefficients = p.segment(static_cast<Eigen::Index>(f) * width, width);
    all += std::norm(coefficients[0]) + 0.5 * coefficients.tail(width - 1).squaredNorm();
    const int highest = problem.coordinateHarmonics()[f];
    if (highest > 0) top += 0.5 * coefficients.segment(2 * highest - 1, 2).squaredNorm();
  }
  return all > 0 ? top / all : 1.0;
}

/// Grows the Krylov space until the exponents near zero are known, and what they say of det(∂h/∂z) is right.
class HillSearch {
 public:
  HillSearch(const HarmonicBalanceProblem& problem, const JacobianSolver& solver, double omega)
      : problem_(problem),
        hill_(problem, solver, omega),
        determinantSign_(solver.factorization()->determinantSign()),
        arnoldi_([this](const Vector& x) { return hill_.apply(x); }, hill_.apply(firstVector(hill_.size())),
                 static_cast<int>(std::min<Eigen::Index>(hill_.size(), mostSteps))) {}

  bool run() {
    arnoldi_.extend(firstSteps);
    while (true) {
      if (arnoldi_.dimension() == 0) return false;
      pairs_ = arnoldi_.ritzPairs();
      if ((settled() || arnoldi_.invariant()) && parityHolds()) return true;
      if (arnoldi_.exhausted()) return false;
      arnoldi_.extend(stepsAtOnce);
    }
  }

  std::vector<HillExponent> found() const {
    std::vector<HillExponent> list;
    for (Eigen::Index i = 0; i < pairs_.values.size(); ++i) {
      if (!converged(i)) continue;
      const Eigen::VectorXcd p = arnoldi_.expand(pairs_.vectors.col(i)).tail(problem_.size());
      list.push_back({1.0 / pairs_.values[i], topEnergy(problem_, p)});
    }
    return list;
  }

 private:
  bool converged(Eigen::Index i) const {
    // ρ and 1/ρ have real parts of one sign and, relative to their moduli, of one size.
    const double needed =
        std::max(exponentTolerance * std::abs(pairs_.values[i]), realPartTolerance * std::abs(pairs_.values[i].real()));
    return pairs_.errors[i] <= needed;
  }

  bool settled() const {
    for (Eigen::Index i = 0; i < pairs_.values.size(); ++i) {
      if (std::abs(pairs_.values[i]) * searchRadius < 1)
        return pairs_.errors[i] <= outsideTolerance * std::abs(pairs_.values[i]);
      if (!converged(i)) return false;
    }
    return false;
  }

  /// det(ρ² ω² M + ρ ω Δ + ∂h/∂z) is positive for large real ρ, so a negative det(∂h/∂z) means an odd number of
  /// positive roots.
  bool parityHolds() const {
    int positive = 0;
    for (Eigen::Index i = 0; i < pairs_.values.size(); ++i)
      if (converged(i) && pairs_.values[i].imag() == 0 && pairs_.values[i].real() > 0) ++positive;
    return (positive % 2 != 0) == (determinantSign_ < 0);
  }

  const HarmonicBalanceProblem& problem_;
  HillOperator hill_;
  int determinantSign_;
  solvers::Arnoldi arnoldi_;
  solvers::RitzPairs pairs_;
};

/// Whether an exponent stands for a multiplier of its own: one copy of each does. Near Im ρ = ±1/2 each in the upper
/// half does, whether it is a negative multiplier (whose other copy is its conjugate) or one of a pair near -1.
bool inStrip(Exponent exponent) {
  const double height = std::abs(exponent.imag());
  return height < 0.5 - stripMargin || (height <= 0.5 + stripMargin && exponent.imag() > 0);
}

/// The best copy of an exponent, moved to where that stands.
HillExponent bestCopy(const HillExponent& original, const std::vector<HillExponent>& all) {
  HillExponent best = original;
  if (original.topEnergy <= goodTopEnergy) return best;
  const double distance = std::min(copyDistance, original.topEnergy);
  for (const HillExponent& other : all) {
    const double shift = std::round(other.exponent.imag() - original.exponent.imag());
    const Exponent copy = other.exponent - Exponent(0, shift);
    if (shift != 0 && std::abs(copy - original.exponent) < distance && other.topEnergy < best.topEnergy)
      best = {copy, other.topEnergy};
  }
  return best;
}

}  // namespace

Stability floquetStability(const HarmonicBalanceProblem& problem, const JacobianSolver& solver, double omega) {
  Stability stability;
  if (problem.basis().hasTwoFrequencies()) return stability;
  HillSearch search(problem, solver, omega);
  if (!search.run()) return stability;
  const std::vector<HillExponent> all = search.found();
  std::vector<Exponent> exponents;
  for (const HillExponent& candidate : all) {
    if (!inStrip(candidate.exponent)) continue;
    const HillExponent best = bestCopy(candidate, all);
    if (best.topEnergy <= mostTopEnergy) exponents.push_back(best.exponent);
  }
  std::stable_sort(exponents.begin(), exponents.end(), [](Exponent a, Exponent b) { return a.real() > b.real(); });
  for (const Exponent exponent : exponents) {
    const Exponent logarithm = 2 * std::numbers::pi * exponent;
    if (logarithm.real() > unitCircleTolerance) ++stability.unstableCount;
    stability.multipliers.push_back(std::exp(logarithm));
  }
  const std::size_t kept = multipliersKept + static_cast<std::size_t>(stability.unstableCount);
  if (stability.multipliers.size() > kept) stability.multipliers.resize(kept);
  stability.state = stability.unstableCount > 0 ? StabilityState::unstable : StabilityState::stable;
  return stability;
}

Stability floquetStability(const HarmonicBalanceProblem& problem, const Vector& z, double omega) {
  JacobianSolver solver(problem);
  Vector h;
  solver.linearize(z, omega, h, nullptr);
  return solver.factorize() ? floquetStability(problem, solver, omega) : Stability{};
}

}  // namespace pliant::harmonic
