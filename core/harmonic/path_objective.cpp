#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/harmonic/design_objective.hpp"
#include "core/harmonic/path_length.hpp"
#include "core/math/phase_shift.hpp"

namespace pliant::harmonic {

namespace {

using std::numbers::pi;

double swingOf(const Matrix& coefficients) { return coefficients.bottomRows(coefficients.rows() - 1).squaredNorm(); }

/// Motion and targets with the same number of harmonics.
class PathComparison {
 public:
  PathComparison(const HarmonicBalanceProblem& problem, const Vector& z, const PathGoal& goal) : goal_(goal) {
    const int harmonics = problem.basis().harmonics();
    for (const TargetPath& path : goal.paths) {
      motions_.push_back(nodeCoefficients(problem, z, path.node));
      Matrix target = Matrix::Zero(2 * harmonics + 1, path.coefficients.cols());
      const Eigen::Index kept = std::min(target.rows(), path.coefficients.rows());
      target.topRows(kept) = path.coefficients.topRows(kept);
      targets_.push_back(std::move(target));
    }
  }

  /// f_Dist of one path.
  double distance(std::size_t path, double phase) const { return difference(path, phase).squaredNorm(); }
  double distance(double phase) const {
    double sum = 0;
    for (std::size_t i = 0; i < motions_.size(); ++i) sum += distance(i, phase);
    return sum;
  }
  /// Half its derivative by the coefficients of the motion.
  Matrix halfGradient(std::size_t path, double phase) const {
    Matrix result = difference(path, phase);
    result.row(0) *= std::numbers::sqrt2;
    return result;
  }
  /// Σ ŝ² + ĉ² of one target, or of all.
  double swing(std::size_t path) const { return swingOf(targets_[path]); }
  double swing() const {
    double sum = 0;
    for (const Matrix& target : targets_) sum += swingOf(target);
    return sum;
  }

 private:
  Matrix difference(std::size_t path, double phase) const {
    Matrix result = motions_[path] - math::shiftedInPhase(targets_[path], phase);
    result.row(0) *= goal_.matchPlace ? std::numbers::sqrt2 : 0;
    return result;
  }

  const PathGoal& goal_;
  std::vector<Matrix> motions_, targets_;
};

class PathObjective final : public DesignObjective {
 public:
  explicit PathObjective(PathGoal goal) : goal_(std::move(goal)) {}

  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector& z) const override {
    const PathComparison comparison(problem, z, goal_);
    const Model& model = problem.model();
    const double alpha = goal_.sharpness / comparison.swing();
    Vector distances(goal_.phases);
    for (int i = 0; i < goal_.phases; ++i) distances[i] = comparison.distance(phaseOf(i));
    Vector weights = (-alpha * (distances.array() - distances.minCoeff())).exp();
    weights /= weights.sum();
    ObjectiveValue result{weights.dot(distances), Matrix::Zero(problem.basis().size(), model.coordinateCount()),
                          Vector::Zero(static_cast<Eigen::Index>(model.parameters.size()))};
    // A phase's share in the derivative: of its weight, and of what its distance does to the weights.
    const Vector shares = weights.array() * (1 - alpha * (distances.array() - result.value));
    for (int i = 0; i < goal_.phases; ++i) {
      if (shares[i] == 0) continue;
      for (std::size_t path = 0; path < goal_.paths.size(); ++path)
        result.byCoefficients.middleCols(goal_.paths[path].node * model.dimension, model.dimension) +=
            2 * shares[i] * comparison.halfGradient(path, phaseOf(i));
    }
    return result;
  }

 private:
  double phaseOf(int i) const { return 2 * pi * i / goal_.phases; }

  PathGoal goal_;
};

}  // namespace

std::shared_ptr<const DesignObjective> makePathObjective(PathGoal goal) {
  return std::make_shared<PathObjective>(std::move(goal));
}

Matrix pathCoefficients(const Matrix& points, int harmonics) {
  const auto count = static_cast<int>(points.cols());
  const int most = std::min(harmonics, (count - 1) / 2);  // more cannot be told from so many points
  Matrix coefficients = Matrix::Zero(2 * harmonics + 1, points.rows());
  const math::HarmonicBasis basis(most, count);
  coefficients.topRows(basis.size()) = basis.analysis() * points.transpose();
  return coefficients;
}

PathDistance pathDistance(const HarmonicBalanceProblem& problem, const Vector& z, const PathGoal& goal) {
  const PathComparison comparison(problem, z, goal);
  // f_Dist is a trigonometric polynomial of φ of order H: a grid that resolves it, then a golden section.
  const int count = 32 * (problem.basis().harmonics() + 1);
  const auto at = [&](double index) { return 2 * pi * index / count; };
  int best = 0;
  for (int i = 1; i < count; ++i)
    if (comparison.distance(at(i)) < comparison.distance(at(best))) best = i;
  double low = at(best - 1), high = at(best + 1);
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  while (high - low > 1e-9) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    (comparison.distance(left) < comparison.distance(right) ? high : low) =
        comparison.distance(left) < comparison.distance(right) ? right : left;
  }
  PathDistance result;
  result.phase = std::fmod(0.5 * (low + high) + 2 * pi, 2 * pi);
  const double distance = comparison.distance(result.phase);
  result.rootMeanSquare = std::sqrt(0.5 * distance / static_cast<double>(goal.paths.size()));
  result.relative = std::sqrt(distance / comparison.swing());
  for (std::size_t path = 0; path < goal.paths.size(); ++path)
    result.relativeOfPath.push_back(std::sqrt(comparison.distance(path, result.phase) / comparison.swing(path)));
  return result;
}

}  // namespace pliant::harmonic
