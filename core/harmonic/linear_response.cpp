#include "core/harmonic/linear_response.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/base/stopwatch.hpp"
#include "core/harmonic/linear_modes.hpp"

namespace pliant::harmonic {

namespace {

/// A harmonic of loads and drives below this fraction of the largest is rounding.
constexpr double negligibleHarmonic = 1e-13;

/// The sample points of the curve: evenly spaced, and closer around the resonances of every driven harmonic.
std::vector<double> sampleFrequencies(const LinearResponseOptions& options, const std::vector<LinearMode>& modes,
                                      const std::vector<int>& harmonics) {
  const double lower = std::min(options.from, options.to), upper = std::max(options.from, options.to);
  std::vector<double> frequencies;
  for (int i = 0; i < options.points; ++i)
    frequencies.push_back(i + 1 == options.points ? upper : lower + (upper - lower) * i / (options.points - 1));
  for (const LinearMode& mode : modes)
    for (const int k : harmonics)
      for (const double halfWidths : {-8.0, -4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0, 8.0}) {
        const double omega = mode.omega / k * (1 + halfWidths * mode.dampingRatio);
        if (omega > lower && omega < upper) frequencies.push_back(omega);
      }
  std::sort(frequencies.begin(), frequencies.end());
  frequencies.erase(std::unique(frequencies.begin(), frequencies.end()), frequencies.end());
  if (options.to < options.from) std::reverse(frequencies.begin(), frequencies.end());
  return frequencies;
}

class LinearCurve {
 public:
  LinearCurve(const HarmonicBalanceProblem& problem, LinearResponse& response, const LinearResponseOptions& options)
      : problem_(problem), response_(response), options_(options) {}

  /// Without coefficients if there is no response.
  ResponsePoint at(double omega) {
    ResponsePoint point;
    point.omega = omega;
    point.arcLength = std::abs(omega - options_.from) / std::abs(options_.to - options_.from);
    point.z = response_.solve(omega);
    if (point.z.size() == 0) return point;
    for (const mechanics::Probe& probe : problem_.model().probes)
      point.amplitudes.push_back(amplitude(problem_, point.z, probe.node));
    point.residual = response_.residual();
    return point;
  }

  /// The largest path length of a probe (of all coordinates' swing for -1) between two frequencies, by golden section.
  ResponsePoint peakBetween(double low, double high, int probe) {
    const double ratio = 0.5 * (std::sqrt(5.0) - 1);
    double a = high - ratio * (high - low), b = low + ratio * (high - low);
    double heightA = height(at(a), probe), heightB = height(at(b), probe);
    while (high - low > options_.locationTolerance * high) {
      if (heightA > heightB) {
        high = b;
        b = a;
        heightB = heightA;
        a = high - ratio * (high - low);
        heightA = height(at(a), probe);
      } else {
        low = a;
        a = b;
        heightA = heightB;
        b = low + ratio * (high - low);
        heightB = height(at(b), probe);
      }
    }
    ResponsePoint peak = at(0.5 * (low + high));
    peak.kind = PointKind::peak;
    peak.probe = probe;
    return peak;
  }

  double height(const ResponsePoint& point, int probe) const {
    if (point.z.size() == 0) return 0;
    return probe < 0 ? problem_.oscillation(point.z).norm()
                     : point.amplitudes[static_cast<std::size_t>(probe)].pathLength;
  }

 private:
  const HarmonicBalanceProblem& problem_;
  LinearResponse& response_;
  const LinearResponseOptions& options_;
};

}  // namespace

LinearResponse::LinearResponse(const HarmonicBalanceProblem& problem, Linearization system)
    : problem_(problem), system_(std::move(system)) {
  const Model& model = problem.model();
  const math::HarmonicBasis& basis = problem.basis();
  Matrix forces(basis.samples(), model.coordinateCount());
  for (int i = 0; i < basis.samples(); ++i)
    forces.row(i) = model.externalForce(2 * std::numbers::pi * i / basis.samples()).transpose();
  loads_ = basis.analysis() * forces(Eigen::all, model.dofs.freeCoordinates);
  loads_.row(0) -= problem.steadyForce()(model.dofs.freeCoordinates).transpose();
  Matrix positions = problem.trajectories(problem.constantCoefficients(system_.equilibrium));
  positions.rowwise() -= system_.equilibrium.transpose();
  swing_ = basis.analysis() * positions;

  const double largestLoad = loads_.cwiseAbs().maxCoeff(), largestSwing = swing_.cwiseAbs().maxCoeff();
  for (int k = 1; k <= basis.harmonics(); ++k)
    if (loads_.middleRows(2 * k - 1, 2).cwiseAbs().maxCoeff() > negligibleHarmonic * largestLoad ||
        swing_.middleRows(2 * k - 1, 2).cwiseAbs().maxCoeff() > negligibleHarmonic * largestSwing)
      drivenHarmonics_.push_back(k);

  mean_ = Vector::Zero(model.dofs.freeCount());
  const Vector load = loads_.row(0).transpose() - system_.couplingStiffness * swing_.row(0).transpose();
  if (math::SparseFactorization stiffness; load.norm() > 0 && stiffness.factorize(system_.stiffness))
    mean_ = stiffness.solve(load).col(0);

  const SparseMatrix stiffness = system_.stiffness + 0.0 * system_.mass;
  system_.mass = system_.mass + 0.0 * system_.stiffness;
  system_.stiffness = stiffness;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index column = 0; column < stiffness.cols(); ++column)
    for (SparseMatrix::InnerIterator it(stiffness, column); it; ++it)
      for (const int i : {0, 1})
        for (const int j : {0, 1})
          entries.emplace_back(2 * static_cast<int>(it.row()) + i, 2 * static_cast<int>(column) + j, 0.0);
  dynamic_.resize(2 * stiffness.rows(), 2 * stiffness.cols());
  dynamic_.setFromTriplets(entries.begin(), entries.end());
}

/// For the unknowns sine, cosine of every coordinate: blocks [a, -b; b, a] of a = K - rate² M and b = rate D.
void LinearResponse::assembleDynamicStiffness(double rate) {
  const Model& model = problem_.model();
  const double* stiffness = system_.stiffness.valuePtr();
  const double* mass = system_.mass.valuePtr();
  for (Eigen::Index column = 0; column < system_.stiffness.cols(); ++column) {
    double* sine = dynamic_.valuePtr() + dynamic_.outerIndexPtr()[2 * column];
    double* cosine = dynamic_.valuePtr() + dynamic_.outerIndexPtr()[2 * column + 1];
    const int end = system_.stiffness.outerIndexPtr()[column + 1];
    for (int s = system_.stiffness.outerIndexPtr()[column]; s < end; ++s) {
      const double a = stiffness[s] - rate * rate * mass[s];
      const double b = rate * (model.massDamping * mass[s] + model.stiffnessDamping * stiffness[s]);
      *sine++ = a;
      *sine++ = b;
      *cosine++ = -b;
      *cosine++ = a;
    }
  }
}

Vector LinearResponse::solve(double omega) {
  const Model& model = problem_.model();
  const int count = model.dofs.freeCount();
  Matrix coefficients = Matrix::Zero(problem_.basis().size(), count);
  coefficients.row(0) = (system_.equilibrium(model.dofs.freeCoordinates) + mean_).transpose();
  double squaredDefect = 0;
  for (const int k : drivenHarmonics_) {
    const double rate = k * omega;
    assembleDynamicStiffness(rate);
    if (!factors_.factorize(dynamic_)) return {};
    const Vector sine = swing_.row(2 * k - 1).transpose(), cosine = swing_.row(2 * k).transpose();
    const auto elastic = [&](const Vector& x) -> Vector {
      return system_.couplingStiffness * x - rate * rate * (system_.couplingMass * x);
    };
    const auto damping = [&](const Vector& x) -> Vector {
      return rate * (model.massDamping * (system_.couplingMass * x) +
                     model.stiffnessDamping * (system_.couplingStiffness * x));
    };
    Vector load(2 * count);
    load(Eigen::seqN(0, count, 2)) = loads_.row(2 * k - 1).transpose() - elastic(sine) + damping(cosine);
    load(Eigen::seqN(1, count, 2)) = loads_.row(2 * k).transpose() - elastic(cosine) - damping(sine);
    const Vector response = factors_.solve(load).col(0);
    squaredDefect += (dynamic_ * response - load).squaredNorm();
    coefficients.middleRows(2 * k - 1, 2) = Eigen::Map<const Matrix>(response.data(), 2, count);
  }
  residual_ = std::sqrt(squaredDefect) / problem_.forceScale(omega);
  return coefficients.reshaped();
}

FrequencyResponse traceLinearResponse(const HarmonicBalanceProblem& problem, const LinearResponseOptions& options,
                                      base::ExecutionContext& context) {
  requireFrequencyRange(options.from, options.to);
  const base::Stopwatch watch;
  FrequencyResponse result;
  const auto finish = [&](base::TerminationType termination, std::string message = {}) {
    result.report.termination = termination;
    result.report.message = std::move(message);
    result.report.seconds = watch.seconds();
    return std::move(result);
  };
  Linearization system = linearizeAtEquilibrium(problem, context);
  if (!system.report.converged()) return finish(system.report.termination, system.report.message);
  const LinearModes modes = computeLinearModes(problem, {.count = 40}, context);
  LinearResponse response(problem, std::move(system));
  LinearCurve curve(problem, response, options);
  const std::vector<double> frequencies = sampleFrequencies(options, modes.modes, response.drivenHarmonics());
  std::vector<ResponsePoint> points;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    if (context.cancelRequested())
      return finish(base::TerminationType::cancelled, "The linear response was cancelled.");
    ResponsePoint point = curve.at(frequencies[i]);
    if (point.z.size() > 0) points.push_back(std::move(point));  // none without damping at a resonance
    context.reportProgress(0.8 * static_cast<double>(i + 1) / static_cast<double>(frequencies.size()));
  }
  const int probes = static_cast<int>(problem.model().probes.size());
  std::vector<ResponsePoint> peaks;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    for (int probe = probes > 0 ? 0 : -1; probe < probes; ++probe) {
      const double middle = curve.height(points[i], probe);
      if (middle > curve.height(points[i - 1], probe) && middle >= curve.height(points[i + 1], probe))
        peaks.push_back(curve.peakBetween(std::min(points[i - 1].omega, points[i + 1].omega),
                                          std::max(points[i - 1].omega, points[i + 1].omega), probe));
    }
  points.insert(points.end(), std::make_move_iterator(peaks.begin()), std::make_move_iterator(peaks.end()));
  std::stable_sort(points.begin(), points.end(),
                   [](const ResponsePoint& one, const ResponsePoint& two) { return one.arcLength < two.arcLength; });
  for (const ResponsePoint& point : points)
    result.report.iterations.push_back({static_cast<int>(result.report.iterations.size()), point.residual, 1, 0});
  result.points = std::move(points);
  return finish(base::TerminationType::converged);
}

}  // namespace pliant::harmonic
