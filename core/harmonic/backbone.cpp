#include "core/harmonic/backbone.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/harmonic/linear_modes.hpp"
#include "core/solvers/continuation_solver.hpp"

namespace pliant::harmonic {

namespace {

/// Amplitude of the first motion looked for, relative to the largest.
constexpr double firstAmplitude = 1e-3;
/// The curve may leave the linear frequency by this factor.
constexpr double widestFrequencyRatio = 20;

/// h(z, ω) = 0 for motions that are cosine series: the cosine (and constant) rows and columns of a problem.
class CosineBranch final : public solvers::ContinuationProblem {
 public:
  CosineBranch(const HarmonicBalanceProblem& problem, double swing)
      : problem_(problem), swing_(swing), masses_(problem.freeMass().diagonal().norm()) {}

  Vector residual(const Vector& x, double omega) override { return reduced(problem_.residual(expanded(x), omega)); }
  /// That of the first motion: with a larger one, its frequency would not have to be right.
  double residualScale(double omega) override { return omega * omega * masses_ * firstAmplitude * swing_; }
  Vector linearize(const Vector& x, double omega) override { return linearizeWith(x, omega, nullptr); }
  Vector linearizePrediction(const Vector& x, double omega, const solvers::BranchPoint& from, double step) override {
    const StressSource stresses{expanded(from.x), expanded(from.x + step * from.direction)};
    return linearizeWith(x, omega, &stresses);
  }
  Vector multiply(const Vector& v) override { return jacobian_ * v; }
  bool factorize() override { return factorization_.factorize(jacobian_); }
  Vector solve(const Vector& b) override { return factorization_.solve(b); }
  bool ends() override { return ended_; }
  void end() { ended_ = true; }

  Vector expanded(const Vector& x) const {
    const Eigen::Index cosines = problem_.basis().harmonics() + 1;
    Vector z = Vector::Zero(problem_.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) z[i / cosines * problem_.basis().size() + 2 * (i % cosines)] = x[i];
    return z;
  }
  Vector reduced(const Vector& z) const {
    const Eigen::Index cosines = problem_.basis().harmonics() + 1;
    Vector x(z.size() / problem_.basis().size() * cosines);
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = z[i / cosines * problem_.basis().size() + 2 * (i % cosines)];
    return x;
  }

 private:
  Vector linearizeWith(const Vector& x, double omega, const StressSource* stresses) {
    Vector h, frequencyDerivative;
    problem_.linearize(expanded(x), omega, h, &full_, &frequencyDerivative, stresses);
    const Eigen::Index width = problem_.basis().size();
    const Eigen::Index cosines = problem_.basis().harmonics() + 1;
    jacobian_.resize(x.size(), x.size());
    jacobian_.reserve(full_.nonZeros() / 3);
    for (Eigen::Index column = 0; column < x.size(); ++column) {
      jacobian_.startVec(column);
      for (SparseMatrix::InnerIterator it(full_, column / cosines * width + 2 * (column % cosines)); it; ++it)
        if (it.row() % width % 2 == 0)
          jacobian_.insertBack(it.row() / width * cosines + it.row() % width / 2, column) = it.value();
    }
    jacobian_.finalize();
    return reduced(frequencyDerivative);
  }

  const HarmonicBalanceProblem& problem_;
  double swing_;
  double masses_;
  SparseMatrix full_;
  SparseMatrix jacobian_;
  math::SparseFactorization factorization_;
  bool ended_ = false;
};

/// Largest length of a node's part of a displacement of the free coordinates.
double largestNodeLength(const Model& model, const Vector& displacement) {
  Vector squares = Vector::Zero(model.nodeCount());
  for (int f = 0; f < model.dofs.freeCount(); ++f)
    if (const int node = model.dofs.freeCoordinates[f] / model.dimension; node < model.nodeCount())
      squares[node] += displacement[f] * displacement[f];
  return std::sqrt(squares.maxCoeff());
}

double largestDisplacement(const HarmonicBalanceProblem& problem, const Vector& z) {
  const Eigen::Map<const Matrix> coefficients(z.data(), problem.basis().size(), problem.model().dofs.freeCount());
  const Matrix swing = problem.basis().synthesis().rightCols(problem.basis().size() - 1) *
                       coefficients.bottomRows(problem.basis().size() - 1);
  double largest = 0;
  for (Eigen::Index i = 0; i < swing.rows(); ++i)
    largest = std::max(largest, largestNodeLength(problem.model(), swing.row(i).transpose()));
  return largest;
}

}  // namespace

HarmonicBalanceProblem freeProblem(const HarmonicBalanceProblem& problem) {
  auto model = std::make_shared<Model>(problem.model());
  model->massDamping = 0;
  model->stiffnessDamping = 0;
  HarmonicBalanceProblem free(std::move(model), problem.basis());
  free.setDriveFraction(0);
  return free;
}

Backbone traceBackbone(const HarmonicBalanceProblem& problem, const BackboneOptions& options,
                       base::ExecutionContext& context, const std::function<void(const ResponsePoint&)>& onPoint) {
  Backbone backbone;
  const LinearModes linear = computeLinearModes(problem, {.count = options.mode}, context);
  if (!linear.report.converged()) {
    backbone.report = linear.report;
    backbone.report.iterations.clear();
    return backbone;
  }
  if (static_cast<int>(linear.modes.size()) < options.mode)
    throw base::InputError(
        "", "the model has no mode " + std::to_string(options.mode) + " about its static equilibrium");
  const LinearMode& mode = linear.modes.back();
  backbone.linearFrequency = mode.omega;
  const Vector shape = mode.shape * (options.maximumAmplitude / largestNodeLength(problem.model(), mode.shape));
  CosineBranch branch(problem, shape.norm());
  Vector swing = Vector::Zero(problem.size());
  for (Eigen::Index f = 0; f < shape.size(); ++f) swing[f * problem.basis().size() + 2] = shape[f];

  solvers::ContinuationOptions continuation;
  continuation.lower = mode.omega / widestFrequencyRatio;
  continuation.upper = mode.omega * widestFrequencyRatio;
  continuation.startDirection = branch.reduced(swing);
  continuation.stateScale = shape.norm();
  continuation.parameterScale = mode.omega;
  continuation.minimumStep = continuation.initialStep / 4096;
  continuation.maximumStep = 1.0 / 40;
  continuation.tolerance = options.newton.tolerance;
  continuation.stepTolerance = options.newton.stepTolerance;
  continuation.maximumPoints = options.maximumPoints;
  solvers::ContinuationSolver solver(branch, continuation);
  const Vector rest = problem.constantCoefficients(linear.equilibrium);
  const Vector start = branch.reduced(rest + firstAmplitude * swing);
  backbone.report =
      solver.trace(start, mode.omega, context, [&](const solvers::BranchPoint& at, solvers::BranchEvent event, int) {
        ResponsePoint point;
        point.kind = event == solvers::BranchEvent::fold ? PointKind::fold : PointKind::regular;
        point.omega = at.parameter;
        point.arcLength = at.arcLength;
        point.z = branch.expanded(at.x);
        for (const mechanics::Probe& probe : problem.model().probes)
          point.amplitudes.push_back(amplitude(problem, point.z, probe.node));
        point.residual = at.residual;
        point.correction = at.correction;
        point.newtonIterations = at.iterations;
        const double reached = largestDisplacement(problem, point.z) / options.maximumAmplitude;
        if (reached >= 1) branch.end();
        context.reportProgress(std::min(reached, 1.0), "amplitude " + std::to_string(reached) + " of the largest");
        backbone.points.push_back(std::move(point));
        if (onPoint) onPoint(backbone.points.back());
      });
  return backbone;
}

}  // namespace pliant::harmonic
