#include "core/harmonic/node_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/harmonic/amplitude.hpp"
#include "core/harmonic/jacobian_solver.hpp"

namespace pliant::harmonic {

namespace {

using base::TerminationType;

constexpr int harmonicsLookedAhead = 2;
constexpr double infinity = std::numeric_limits<double>::infinity();

HarmonicBalanceProblem problemLike(const HarmonicBalanceProblem& problem, int harmonics,
                                   std::vector<int> coordinateHarmonics = {}) {
  return {problem.sharedModel(),
          {harmonics, std::max(problem.basis().samples(), 4 * harmonics + 1)},
          problem.drivePeriods(),
          std::move(coordinateHarmonics)};
}

double longestPath(const HarmonicBalanceProblem& problem, const Vector& z) {
  double longest = 0;
  const auto& probes = problem.model().probes;
  for (const mechanics::Probe& probe : probes)
    longest = std::max(longest, amplitude(problem, z, probe.node).pathLength);
  if (probes.empty())
    for (int node = 0; node < problem.model().nodeCount(); ++node)
      longest = std::max(longest, amplitude(problem, z, node).pathLength);
  return longest;
}

/// The coefficients that `coarse` leaves out, of `finer`, from the residual and the Jacobian of `finer` at z: size() of
/// `finer`, with zeros for those that `coarse` has. NaN where the equations of a harmonic are singular.
Vector estimateLeftOut(const HarmonicBalanceProblem& coarse, const HarmonicBalanceProblem& finer, const Vector& z,
                       double omega) {
  const std::vector<int>& harmonics = coarse.coordinateHarmonics();
  const int width = finer.basis().size();
  Vector h;
  SparseMatrix jacobian;
  finer.linearize(z, omega, h, &jacobian, nullptr);
  Vector missing = Vector::Zero(z.size());
  for (int k = 1; k <= finer.basis().harmonics(); ++k) {
    std::vector<int> lacking;                      // coordinates without this harmonic
    std::vector<int> place(harmonics.size(), -1);  // of a coordinate among them
    for (std::size_t f = 0; f < harmonics.size(); ++f) {
      if (harmonics[f] >= k) continue;
      place[f] = static_cast<int>(lacking.size());
      lacking.push_back(static_cast<int>(f));
    }
    if (lacking.empty()) continue;
    const auto count = static_cast<Eigen::Index>(2 * lacking.size());
    SparseMatrix matrix(count, count);
    matrix.reserve(jacobian.nonZeros() / (width * width) * 4 + count);
    Vector right(count);
    for (Eigen::Index column = 0; column < count; ++column) {
      const Eigen::Index full = static_cast<Eigen::Index>(lacking[column / 2]) * width + 2 * k - 1 + column % 2;
      right[column] = -h[full];
      matrix.startVec(column);
      for (SparseMatrix::InnerIterator it(jacobian, full); it; ++it) {
        const Eigen::Index pair = it.row() % width - (2 * k - 1);
        const int row = place[it.row() / width];
        if (row >= 0 && (pair == 0 || pair == 1)) matrix.insertBack(2 * row + pair, column) = it.value();
      }
    }
    matrix.finalize();
    math::SparseFactorization factorization;
    const Vector solution = factorization.factorize(matrix)
                                ? Vector(factorization.solve(right))
                                : Vector::Constant(count, std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index i = 0; i < count; ++i)
      missing[static_cast<Eigen::Index>(lacking[i / 2]) * width + 2 * k - 1 + i % 2] = solution[i];
  }
  return missing;
}

/// What the coefficients that `coarse` has would change by if `missing` (of `finer`, like z) were there as well: near a
/// resonance more than `missing` itself. size() of `finer`.
Vector estimateReaction(const HarmonicBalanceProblem& coarse, const HarmonicBalanceProblem& finer, const Vector& z,
                        const Vector& missing, const PeriodicMotion& motion) {
  const int few = coarse.basis().harmonics(), many = finer.basis().harmonics();
  const Vector force = HarmonicBalanceProblem::changeHarmonics(finer.residual(z + missing, motion.omega), many, few);
  std::shared_ptr<const math::SparseFactorization> factors = motion.factorization;
  if (!factors) {
    JacobianSolver solver(coarse);
    Vector h;
    solver.linearize(motion.z, motion.omega, h, nullptr);
    if (solver.factorize()) factors = solver.factorization();
  }
  if (!factors) return Vector::Constant(z.size(), std::numeric_limits<double>::quiet_NaN());
  const Vector reaction = -coarse.expanded(factors->solve(coarse.restricted(force)));
  return HarmonicBalanceProblem::changeHarmonics(reaction, few, many);
}

/// Lengths of coefficients, added up by nodes and scalar coordinates (the groups).
class GroupLengths {
 public:
  GroupLengths(const Model& model, int harmonics) : model_(model), harmonics_(harmonics) {}

  /// Group x (harmonics + 1) [m]: how far each harmonic moves it, the constant first.
  Matrix operator()(const Vector& coefficients) const {
    const Eigen::Index width = 2 * harmonics_ + 1;
    Matrix squares = Matrix::Zero(groupOf(model_.coordinateCount() - 1) + 1, harmonics_ + 1);
    for (int f = 0; f < model_.dofs.freeCount(); ++f) {
      const Eigen::Index group = groupOf(model_.dofs.freeCoordinates[f]);
      squares(group, 0) += coefficients[f * width] * coefficients[f * width];
      for (int k = 1; k <= harmonics_; ++k)
        squares(group, k) += coefficients.segment<2>(f * width + 2 * k - 1).squaredNorm();
    }
    return squares.cwiseSqrt();
  }

  /// The harmonics with which no group lacks more than `tolerance` of `missing`, at most `most`, at least `present`.
  std::vector<int> harmonicsFor(const Matrix& missing, double tolerance, int most,
                                const std::vector<int>& present) const {
    std::vector<int> wanted = present;
    for (std::size_t f = 0; f < wanted.size(); ++f) {
      const Eigen::Index group = groupOf(model_.dofs.freeCoordinates[f]);
      double beyond = 0;
      int harmonics = harmonics_;
      while (harmonics > 0 && beyond + missing(group, harmonics) <= tolerance) beyond += missing(group, harmonics--);
      wanted[f] = std::max(wanted[f], std::min(harmonics, most));
    }
    return wanted;
  }

 private:
  Eigen::Index groupOf(int coordinate) const {
    const int positions = model_.nodeCount() * model_.dimension;
    return coordinate < positions ? coordinate / model_.dimension : model_.nodeCount() + coordinate - positions;
  }

  const Model& model_;
  int harmonics_;
};

}  // namespace

NodeHarmonicsMotion solveWithHarmonicsPerNode(HarmonicBalanceProblem problem, double omega, double relativeChange,
                                              int maximumHarmonics, const PeriodicMotionOptions& options,
                                              base::ExecutionContext& context) {
  PeriodicMotion motion = solvePeriodicMotion(problem, omega, options, context);
  double leftOut = std::numeric_limits<double>::quiet_NaN();
  while (motion.report.converged()) {
    const int harmonics = problem.basis().harmonics();
    const int more = harmonics + harmonicsLookedAhead;
    const HarmonicBalanceProblem finer = problemLike(problem, more);
    const Vector padded = HarmonicBalanceProblem::changeHarmonics(motion.z, harmonics, more);
    const Vector missing = estimateLeftOut(problem, finer, padded, omega);
    const Vector change = missing + estimateReaction(problem, finer, padded, missing, motion);
    const GroupLengths lengthsOf(problem.model(), more);
    const double length = longestPath(problem, motion.z);
    if (length == 0)
      leftOut = 0;
    else
      leftOut = change.allFinite() ? lengthsOf(change).rowwise().sum().maxCoeff() / length : infinity;
    if (leftOut <= relativeChange) break;
    // Where it is the reaction that is too large, less has to be left out than each node's own share would allow.
    std::vector<int> wanted = problem.coordinateHarmonics();
    const Matrix shares = lengthsOf(missing);
    for (double share = relativeChange * length; share > 0 && wanted == problem.coordinateHarmonics(); share *= 0.3)
      wanted = lengthsOf.harmonicsFor(shares, share, maximumHarmonics, problem.coordinateHarmonics());
    if (wanted == problem.coordinateHarmonics()) {
      motion.report.termination = TerminationType::iterationLimit;
      motion.report.message =
          std::to_string(maximumHarmonics) +
          " harmonics, the most allowed, are not enough: those left out would move a node by about " +
          std::to_string(leftOut) + " of the longest path.";
      break;
    }
    const int most = *std::max_element(wanted.begin(), wanted.end());
    const Vector start =
        HarmonicBalanceProblem::changeHarmonics(change.allFinite() ? Vector(padded + change) : padded, more, most);
    problem = problemLike(problem, most, std::move(wanted));
    leftOut = std::numeric_limits<double>::quiet_NaN();  // of this problem nothing is known yet
    motion = solvePeriodicMotion(problem, omega, options, context, start);
  }
  return {std::move(problem), std::move(motion), leftOut};
}

}  // namespace pliant::harmonic
