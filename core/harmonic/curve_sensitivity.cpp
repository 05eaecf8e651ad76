#include "core/harmonic/curve_sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/harmonic/bordered_jacobian.hpp"
#include "core/harmonic/design_gradient.hpp"
#include "core/harmonic/parameter_jacobian.hpp"

namespace pliant::harmonic {

namespace {

/// -‖z without constants‖: what peaks of a model without probes are of.
class OscillationObjective final : public DesignObjective {
 public:
  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector& z) const override {
    const Model& model = problem.model();
    ObjectiveValue result{0, Matrix::Zero(problem.basis().size(), model.coordinateCount()),
                          Vector::Zero(static_cast<Eigen::Index>(model.parameters.size()))};
    const Vector swing = problem.oscillation(z);
    result.value = -swing.norm();
    result.byCoefficients(Eigen::all, model.dofs.freeCoordinates) =
        swing.reshaped(problem.basis().size(), model.dofs.freeCount()) / result.value;
    return result;
  }
};

/// -A of a probe, or of the whole model.
std::shared_ptr<const DesignObjective> lossOf(const HarmonicBalanceProblem& problem, int probe) {
  if (probe < 0) return std::make_shared<OscillationObjective>();
  return makeAmplitudeObjective({{problem.model().probes.at(static_cast<std::size_t>(probe)).node}, {}, {}});
}

/// The Lagrangian -A(u, p) - λᵀh(u, p) of one peak.
class PeakLagrangian {
 public:
  PeakLagrangian(const HarmonicBalanceProblem& problem, int probe, const std::vector<int>& parameters)
      : problem_(problem), loss_(lossOf(problem, probe)), parameters_(parameters) {}

  double amplitude(const Vector& u) const { return -loss_->evaluate(problem_, u.head(problem_.size())).value; }
  /// ∂(-A)/∂u.
  Vector lossGradient(const Vector& u) const {
    const ObjectiveValue at = loss_->evaluate(problem_, u.head(problem_.size()));
    Vector gradient = Vector::Zero(u.size());
    gradient.head(problem_.size()) =
        problem_.withoutLeftOut(at.byCoefficients(Eigen::all, problem_.model().dofs.freeCoordinates).reshaped());
    return gradient;
  }
  /// ∂L/∂u.
  Vector byMotion(const Vector& u, const Vector& multipliers) const {
    Vector h, frequencyDerivative;
    SparseMatrix jacobian;
    problem_.linearize(u.head(problem_.size()), u[u.size() - 1], h, &jacobian, &frequencyDerivative);
    Vector gradient = lossGradient(u);
    gradient.head(problem_.size()) -= problem_.expanded(jacobian.transpose() * problem_.restricted(multipliers));
    gradient[u.size() - 1] -= frequencyDerivative.dot(multipliers);
    return gradient;
  }
  /// ∂L/∂p.
  Vector byParameters(const Vector& u, const Vector& multipliers) const {
    const Vector z = u.head(problem_.size());
    return directDerivative(problem_, loss_->evaluate(problem_, z), parameters_) -
           ParameterJacobian(problem_, z, u[u.size() - 1], parameters_).transposedTimes(multipliers);
  }

 private:
  const HarmonicBalanceProblem& problem_;
  std::shared_ptr<const DesignObjective> loss_;
  const std::vector<int>& parameters_;
};

/// Of derivatives along the tangent; the rounding of ∂h/∂z in a stiff sheet forbids much smaller ones.
constexpr double tangentStep = 1e-3;

Vector stacked(const Vector& z, double omega) {
  Vector u(z.size() + 1);
  u << z, omega;
  return u;
}

/// How far a peak may be from where it is looked for, in the measure of the tangent.
struct PeakSearch {
  int mostMoves;
  double farthest;
};

/// Newton's method for a peak: onto the curve, normal to its tangent, then along it, in turns.
class PeakLocator {
 public:
  PeakLocator(const HarmonicBalanceProblem& problem, const PeakLagrangian& lagrangian, const ResponsePoint& start)
      : problem_(problem), lagrangian_(lagrangian), u_(stacked(start.z, start.omega)) {}

  bool run(const PeakSearch& search) {
    constexpr double exactEnough = 1e-12;
    double travelled = 0, previous = std::numeric_limits<double>::infinity();
    for (int move = 0; move < search.mostMoves; ++move) {
      if (!findCurve(search.farthest)) return false;
      jacobian_.emplace(problem_, state(), omega(), &tangent_);
      if (!jacobian_->regular()) return false;
      tangent_ = jacobian_->tangent();
      const Vector lossGradient = lagrangian_.lossGradient(u_);
      multipliers_ = jacobian_->solveTransposed(lossGradient).col(0).head(problem_.size());
      curvature_ = alongTangent([&](const Vector& u) { return lagrangian_.byMotion(u, multipliers_); });
      const double slope = lossGradient.dot(tangent_);
      const double distance = -slope / std::abs(bending());
      const double size = std::abs(distance);
      const bool rounded = size <= roundingDistance && size > 0.5 * std::exchange(previous, size);
      if (bending() > 0 && (size <= exactEnough || rounded)) return true;
      // Where the amplitude is not yet concave, along it as far as one dares.
      const double limit = 0.3 * search.farthest;
      const double step = bending() > 0 ? std::clamp(distance, -limit, limit) : std::copysign(limit, -slope);
      travelled += std::abs(step);
      if (!(travelled <= search.farthest)) return false;
      last_ = state();
      u_ += step * tangent_;
    }
    return false;
  }

  PeakSensitivity sensitivity(const std::vector<int>& parameters) const {
    const Eigen::Index n = problem_.size();
    PeakSensitivity result;
    result.omega = omega();
    result.z = state();
    result.amplitude = lagrangian_.amplitude(u_);
    result.residual = jacobian_->residual().norm() / problem_.forceScale(omega());
    result.amplitudeDerivative = -lagrangian_.byParameters(u_, multipliers_);
    Matrix right(n + 1, 2);
    right << curvature_, Vector::Unit(n + 1, n);
    const Matrix adjoint = jacobian_->solveTransposed(right);
    const ParameterJacobian byParameters(problem_, state(), omega(), parameters);
    const Vector change = alongTangent([&](const Vector& u) { return lagrangian_.byParameters(u, multipliers_); }) -
                          byParameters.transposedTimes(adjoint.col(0).head(n));
    result.omegaDerivative = -byParameters.transposedTimes(adjoint.col(1).head(n)) - tangent_[n] / bending() * change;
    return result;
  }

 private:
  Vector state() const { return u_.head(problem_.size()); }
  double omega() const { return u_[problem_.size()]; }
  double bending() const { return curvature_.dot(tangent_); }
  Vector alongTangent(const std::function<Vector(const Vector&)>& derivative) const {
    const auto difference = [&](double step) -> Vector {
      return derivative(u_ + step * tangent_) - derivative(u_ - step * tangent_);
    };
    return (8 * difference(tangentStep) - difference(2 * tangentStep)) / (12 * tangentStep);
  }

  /// Stresses are extrapolated from the iterate before, as always in Newton's method: see "Thin shells" in README.md.
  bool findCurve(double farthest) {
    constexpr int mostIterations = 15;
    constexpr double exactEnough = 1e-10;
    double travelled = 0;
    for (int i = 0; i < mostIterations; ++i) {
      const StressSource stresses{last_, state(), 1, 1};
      const BorderedJacobian jacobian(problem_, state(), omega(), tangent_.size() > 0 ? &tangent_ : nullptr,
                                      last_.size() > 0 ? &stresses : nullptr);
      if (!jacobian.regular()) return false;
      tangent_ = jacobian.tangent();
      const Vector step = jacobian.solve(stacked(jacobian.residual(), 0));
      const double length = jacobian.length(step);
      travelled += length;
      if (!(travelled <= 2 * farthest)) return false;
      last_ = state();
      u_ -= step;
      if (length <= exactEnough || (length <= roundingLength && length > 0.5 * previousLength_)) return true;
      previousLength_ = length;
    }
    return false;
  }

  // Corrections and distances below these that do not shrink are rounding, of which a stiff sheet's tangent has most.
  static constexpr double roundingLength = 1e-7;
  static constexpr double roundingDistance = 1e-5;

  const HarmonicBalanceProblem& problem_;
  const PeakLagrangian& lagrangian_;
  Vector u_;     ///< (z, ω)
  Vector last_;  ///< the coefficients that u_ was extrapolated from; empty at first
  Vector tangent_;
  double previousLength_ = std::numeric_limits<double>::infinity();
  std::optional<BorderedJacobian> jacobian_;
  Vector multipliers_, curvature_;
};

std::optional<PeakSensitivity> locatePeak(const HarmonicBalanceProblem& problem, const ResponsePoint& start,
                                          const std::vector<int>& parameters, const PeakSearch& search) {
  const PeakLagrangian lagrangian(problem, start.probe, parameters);
  PeakLocator locator(problem, lagrangian, start);
  if (!locator.run(search)) return std::nullopt;
  return locator.sensitivity(parameters);
}

}  // namespace

std::optional<PeakSensitivity> peakSensitivity(const HarmonicBalanceProblem& problem, const ResponsePoint& peak,
                                               const std::vector<int>& parameters) {
  return locatePeak(problem, peak, parameters, {6, 0.05});
}

std::optional<PeakSensitivity> followPeak(const HarmonicBalanceProblem& problem, const ResponsePoint& peak,
                                          const std::vector<int>& parameters) {
  return locatePeak(problem, peak, parameters, {20, 0.5});
}

PointSensitivity pointSensitivity(const HarmonicBalanceProblem& problem, const ResponsePoint& point,
                                  const std::vector<int>& parameters) {
  const Eigen::Index n = problem.size();
  const auto probes = static_cast<Eigen::Index>(problem.model().probes.size());
  const BorderedJacobian jacobian(problem, point.z, point.omega);
  if (!jacobian.regular()) return {};
  const Vector u = stacked(point.z, point.omega);
  Matrix right = Matrix::Zero(n + 1, probes + 1);
  std::vector<PeakLagrangian> losses;
  for (Eigen::Index i = 0; i < probes; ++i)
    right.col(i) = losses.emplace_back(problem, static_cast<int>(i), parameters).lossGradient(u);
  right(n, probes) = 1;
  const Matrix adjoint = jacobian.solveTransposed(right).topRows(n);
  const ParameterJacobian byParameters(problem, point.z, point.omega, parameters);
  PointSensitivity result;
  result.omega = -byParameters.transposedTimes(adjoint.col(probes));
  result.pathLength.resize(probes, static_cast<Eigen::Index>(parameters.size()));
  for (Eigen::Index i = 0; i < probes; ++i)
    result.pathLength.row(i) =
        byParameters.transposedTimes(adjoint.col(i)).transpose() -
        directDerivative(problem, lossOf(problem, static_cast<int>(i))->evaluate(problem, point.z), parameters)
            .transpose();
  return result;
}

PredictedPoint predictPoint(const ResponsePoint& point, const PointSensitivity& sensitivity,
                            const Vector& parameterChange) {
  PredictedPoint predicted{point.omega, {}};
  const bool known = sensitivity.omega.size() > 0;
  if (known) predicted.omega += sensitivity.omega.dot(parameterChange);
  for (std::size_t i = 0; i < point.amplitudes.size(); ++i)
    predicted.pathLengths.push_back(
        point.amplitudes[i].pathLength +
        (known ? sensitivity.pathLength.row(static_cast<Eigen::Index>(i)).dot(parameterChange) : 0));
  return predicted;
}

}  // namespace pliant::harmonic
