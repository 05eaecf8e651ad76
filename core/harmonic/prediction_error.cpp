#include "core/harmonic/prediction_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/harmonic/jacobian_solver.hpp"
#include "core/harmonic/refined_solve.hpp"
#include "core/mechanics/drive_frequency.hpp"
#include "core/mechanics/joint_parameter.hpp"

namespace pliant::harmonic {

namespace {

/// Places in steps, and the weights of a difference there; those with the weight 0 are not looked at.
struct Difference {
  std::array<double, 7> offsets;
  std::array<double, 7> weights;
};
/// In the middle, and at either end of what the parameters allow. The second is of order 2. The third is of order 4:
/// in a thin shell, its error counts in proportion to the stiffness in the plane, the derivative to that of bending.
using Differences = std::array<Difference, 3>;
constexpr Differences secondDifferences = {Difference{{0, -1, 1}, {-2, 1, 1}}, Difference{{0, 1, 2, 3}, {2, -5, 4, -1}},
                                           Difference{{0, -1, -2, -3}, {2, -5, 4, -1}}};
constexpr Differences thirdDifferences = {
    Difference{{-3, -2, -1, 1, 2, 3}, {1. / 8, -1, 13. / 8, -13. / 8, 1, -1. / 8}},
    Difference{{0, 1, 2, 3, 4, 5, 6}, {-49. / 8, 29, -461. / 8, 62, -307. / 8, 13, -15. / 8}},
    Difference{{0, -1, -2, -3, -4, -5, -6}, {49. / 8, -29, 461. / 8, -62, 307. / 8, -13, 15. / 8}}};

}  // namespace

PredictionError::PredictionError(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion,
                                 const ResponseSensitivity& sensitivity)
    : problem_(problem),
      omega_(motion.omega),
      z_(motion.z),
      derivative_(sensitivity.derivative()),
      swing_(problem.oscillation(motion.z).norm()) {
  if (!sensitivity.regular()) return;
  JacobianSolver solver(problem_);
  Vector h;
  solver.linearize(z_, omega_, h, nullptr);
  jacobian_ = solver.jacobian();
  Matrix answer;
  if (motion.factorization && solveRefined(jacobian_, *motion.factorization, false, problem_.restricted(z_), answer))
    factors_ = motion.factorization;
  else if (solver.factorize())
    factors_ = solver.factorization();
}

/// Small enough for the difference, and large enough for the rounding of residuals.
double PredictionError::step(const Vector& direction, const Vector& tangent) const {
  constexpr double share = 0.01;  // of the swing, and of a parameter's range
  const Model& model = problem_.model();
  double largest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    const auto& parameter = *model.parameters[static_cast<std::size_t>(i)];
    const double range = parameter.maximum(model) - parameter.minimum(model);
    const double size = range > 0 ? range : std::abs(parameter.value(model));
    if (direction[i] != 0 && size > 0) largest = std::min(largest, size / std::abs(direction[i]));
  }
  if (!std::isfinite(largest)) largest = 1 / direction.norm();
  const double motion = tangent.norm();
  return share * std::min(largest, motion > 0 && swing_ > 0 ? swing_ / motion : largest);
}

Vector PredictionError::residualAt(const Vector& direction, const MotionDerivatives& path, double s) const {
  if (s == 0) return problem_.residual(z_, omega_);
  const Model& model = problem_.model();
  Vector values(direction.size());
  for (Eigen::Index i = 0; i < direction.size(); ++i)
    values[i] = model.parameters[static_cast<std::size_t>(i)]->value(model) + s * direction[i];
  const HarmonicBalanceProblem changed(
      std::make_shared<const Model>(mechanics::withParameterValues(model, model.parameters, values)), problem_.basis(),
      problem_.drivePeriods(), problem_.coordinateHarmonics());
  Vector z = z_ + s * path.first;
  if (path.second.size() > 0) z += 0.5 * s * s * path.second;
  return changed.residual(z, mechanics::driveFrequency(changed.model()).value_or(omega_));
}

/// The first derivative that `path` does not have yet.
Vector PredictionError::nextDerivative(const Vector& direction, const MotionDerivatives& path) const {
  const bool second = path.second.size() == 0;
  const double size = (second ? 1 : 0.5) * step(direction, path.first);
  const Differences& differences = second ? secondDifferences : thirdDifferences;
  Vector sum;
  for (const Difference& difference : differences) try {
      sum = Vector::Zero(z_.size());
      for (std::size_t i = 0; i < difference.offsets.size(); ++i)
        if (difference.weights[i] != 0)
          sum += difference.weights[i] * residualAt(direction, path, difference.offsets[i] * size);
      break;
    } catch (const base::InputError&) {
      // The parameters end on this side; the last one's error is the one to report.
      if (&difference == &differences.back()) throw;
    }
  sum /= -std::pow(size, second ? 2 : 3);
  Matrix answer;
  // That these factors are near enough was seen before; the last digits do not matter here.
  solveRefined(jacobian_, *factors_, false, problem_.restricted(sum), answer);
  return problem_.expanded(answer);
}

MotionDerivatives PredictionError::derivatives(const Vector& direction, int order) const {
  MotionDerivatives path{derivative_ * direction, {}, {}};
  const Vector nothing = Vector::Zero(z_.size());
  const bool moves = !direction.isZero(0);
  if (order >= 2) path.second = moves ? nextDerivative(direction, path) : nothing;
  if (order >= 3) path.third = moves ? nextDerivative(direction, path) : nothing;
  return path;
}

Vector PredictionError::predict(const Vector& parameterChange, int order) const {
  const MotionDerivatives path = derivatives(parameterChange, order);
  Vector z = z_ + path.first;
  if (order >= 2) z += path.second / 2;
  if (order >= 3) z += path.third / 6;
  return z;
}

double PredictionError::estimate(const Vector& parameterChange) const {
  return 0.5 * derivatives(parameterChange, 2).second.norm() / swing_;
}

ParameterRange PredictionError::trustedRange(int parameter, double share) const {
  const Model& model = problem_.model();
  const auto& changed = *model.parameters.at(static_cast<std::size_t>(parameter));
  const double value = changed.value(model), lower = changed.minimum(model), upper = changed.maximum(model);
  const double reach = trustedReach(Vector::Unit(derivative_.cols(), parameter), share);
  return {std::max(lower, value - reach), std::min(upper, value + reach)};
}

double PredictionError::trustedReach(const Vector& direction, double share) const {
  const MotionDerivatives path = derivatives(direction, 3);
  const double square = path.second.norm() / 2, allowed = share * swing_;
  if (square == 0) return std::numeric_limits<double>::infinity();
  // square Δ² / (1 - ratio Δ) = allowed
  const double half = 0.5 * allowed * path.third.norm() / (3 * path.second.norm());
  return allowed / (half + std::sqrt(half * half + square * allowed));
}

}  // namespace pliant::harmonic
