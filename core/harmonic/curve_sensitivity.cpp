#include "core/harmonic/curve_sensitivity.hpp"

#include <cmath>

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

/// Newton's method for a point of the curve in the plane normal to its tangent, with the factors of a point nearby.
void correct(const HarmonicBalanceProblem& problem, const BorderedJacobian& jacobian, Vector& u) {
  constexpr int corrections = 3;
  for (int i = 0; i < corrections; ++i) {
    const Vector h = problem.residual(u.head(problem.size()), u[u.size() - 1]);
    u -= jacobian.solve(stacked(h, 0));
  }
}

}  // namespace

std::optional<PeakSensitivity> peakSensitivity(const HarmonicBalanceProblem& problem, const ResponsePoint& peak,
                                               const std::vector<int>& parameters) {
  constexpr int mostMoves = 6;
  constexpr double farthestMove = 0.05, exactEnough = 1e-9;  // in the measure of the tangent
  const PeakLagrangian lagrangian(problem, peak.probe, parameters);
  const Eigen::Index n = problem.size();
  Vector u = stacked(peak.z, peak.omega);
  for (int move = 0; move < mostMoves; ++move) {
    const BorderedJacobian jacobian(problem, u.head(n), u[n]);
    if (!jacobian.regular()) return std::nullopt;
    const Vector& tangent = jacobian.tangent();
    const Vector lossGradient = lagrangian.lossGradient(u);
    const Vector multipliers = jacobian.solveTransposed(lossGradient).col(0).head(n);
    const auto alongTangent = [&](const auto& derivative) -> Vector {
      return (derivative(u + tangentStep * tangent, multipliers) - derivative(u - tangentStep * tangent, multipliers)) /
             (2 * tangentStep);
    };
    const Vector curvature =
        alongTangent([&](const Vector& at, const Vector& by) { return lagrangian.byMotion(at, by); });
    const double bending = curvature.dot(tangent);
    if (!(bending > 0)) return std::nullopt;
    const double distance = -lossGradient.dot(tangent) / bending;
    if (!(std::abs(distance) <= farthestMove)) return std::nullopt;
    if (std::abs(distance) > exactEnough && move + 1 < mostMoves) {
      u += distance * tangent;
      correct(problem, jacobian, u);
      continue;
    }
    PeakSensitivity result;
    result.omega = u[n];
    result.amplitude = lagrangian.amplitude(u);
    result.residual = problem.residual(u.head(n), u[n]).norm() / problem.forceScale(u[n]);
    result.amplitudeDerivative = -lagrangian.byParameters(u, multipliers);
    Matrix right(n + 1, 2);
    right << curvature, Vector::Unit(n + 1, n);
    const Matrix adjoint = jacobian.solveTransposed(right);
    const ParameterJacobian byParameters(problem, u.head(n), u[n], parameters);
    const Vector change =
        alongTangent([&](const Vector& at, const Vector& by) { return lagrangian.byParameters(at, by); }) -
        byParameters.transposedTimes(adjoint.col(0).head(n));
    result.omegaDerivative = -byParameters.transposedTimes(adjoint.col(1).head(n)) - tangent[n] / bending * change;
    return result;
  }
  return std::nullopt;
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
