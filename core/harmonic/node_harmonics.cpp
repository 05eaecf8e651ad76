#include "core/harmonic/node_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/harmonic/amplitude.hpp"

namespace pliant::harmonic {

namespace {

using base::TerminationType;

constexpr int harmonicsLookedAhead = 2;

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
    std::vector<int> lacking;                        // coordinates without this harmonic
    std::vector<int> place(harmonics.size(), -1);    // of a coordinate among them
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

/// How far each harmonic that is left out would move each node or scalar coordinate: group x harmonic, in metres.
class LeftOut {
 public:
  LeftOut(const Model& model, int harmonics, const Vector& missing) : model_(model) {
    const int width = 2 * harmonics + 1;
    Matrix squares = Matrix::Zero(groupOf(model.coordinateCount() - 1) + 1, harmonics);
    for (int f = 0; f < model.dofs.freeCount(); ++f)
      for (int k = 1; k <= harmonics; ++k)
        squares(groupOf(model.dofs.freeCoordinates[f]), k - 1) +=
            missing.segment<2>(static_cast<Eigen::Index>(f) * width + 2 * k - 1).squaredNorm();
    lengths_ = squares.cwiseSqrt();
  }

  /// All harmonics together. NaN counts as infinite.
  double largest() const {
    const Vector sums = lengths_.rowwise().sum();
    return sums.allFinite() ? sums.maxCoeff() : std::numeric_limits<double>::infinity();
  }

  /// The harmonics with which no node lacks more than `tolerance`, at most `most`, at least those in `present`.
  std::vector<int> harmonicsFor(double tolerance, int most, const std::vector<int>& present) const {
    std::vector<int> wanted = present;
    for (std::size_t f = 0; f < wanted.size(); ++f) {
      const Eigen::Index group = groupOf(model_.dofs.freeCoordinates[f]);
      double beyond = 0;
      int harmonics = static_cast<int>(lengths_.cols());
      while (harmonics > 0 && beyond + lengths_(group, harmonics - 1) <= tolerance)
        beyond += lengths_(group, --harmonics);
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
  Matrix lengths_;
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
    const LeftOut lengths(problem.model(), more, missing);
    const double length = longestPath(problem, motion.z);
    leftOut = length > 0 ? lengths.largest() / length : 0;
    if (leftOut <= relativeChange) break;
    std::vector<int> wanted =
        lengths.harmonicsFor(relativeChange * length, maximumHarmonics, problem.coordinateHarmonics());
    if (wanted == problem.coordinateHarmonics()) {
      motion.report.termination = TerminationType::iterationLimit;
      motion.report.message = std::to_string(maximumHarmonics) +
                              " harmonics, the most allowed, are not enough: those left out would move a node by about " +
                              std::to_string(leftOut) + " of the longest path.";
      break;
    }
    const int most = *std::max_element(wanted.begin(), wanted.end());
    const Vector start =
        HarmonicBalanceProblem::changeHarmonics(missing.allFinite() ? Vector(padded + missing) : padded, more, most);
    problem = problemLike(problem, most, std::move(wanted));
    motion = solvePeriodicMotion(problem, omega, options, context, start);
  }
  return {std::move(problem), std::move(motion), leftOut};
}

}  // namespace pliant::harmonic
