#include "core/harmonic/calibration.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/harmonic/calibration_residuals.hpp"

namespace pliant::harmonic {

namespace {

/// Where displacements are measured from must stay where it is.
void requireFixedRest(const Model& model, const std::vector<MeasuredMotion>& measured) {
  if (std::none_of(measured.begin(), measured.end(),
                   [](const MeasuredMotion& motion) { return motion.meaning == MeasuredValue::displacement; }))
    return;
  for (const auto& parameter : model.parameters) {
    const double value = parameter->value(model), minimum = parameter->minimum(model),
                 maximum = parameter->maximum(model);
    const double other = value + 1e-3 * (maximum - value > value - minimum ? maximum - value : minimum - value);
    const Vector moved = parameter->withValue(model, other).restPositions;
    for (const MeasuredMotion& motion : measured)
      for (const MeasuredCoordinate& c : motion.coordinates)
        if (const int i = c.node * model.dimension + c.axis;
            motion.meaning == MeasuredValue::displacement && moved[i] != model.restPositions[i])
          throw base::InputError("", "The parameter '" + parameter->name() +
                                         "' moves the place that displacements are measured from; give positions.");
  }
}

double serialCorrelation(const MeasuredMotion& measured, const Vector& residuals) {
  double products = 0, squares = 0;
  Eigen::Index row = 0;
  for (const MeasuredCoordinate& coordinate : measured.coordinates) {
    const auto size = static_cast<Eigen::Index>((coordinate.values.array() == coordinate.values.array()).count());
    const auto part = residuals.segment(row, size);
    squares += part.squaredNorm();
    products += part.head(size - 1).dot(part.tail(size - 1));
    row += size;
  }
  return squares > 0 ? products / squares : 0;
}

double swingOf(const MeasuredMotion& measured) {
  double squares = 0;
  for (const MeasuredCoordinate& coordinate : measured.coordinates) {
    std::vector<double> known;
    for (const double value : coordinate.values)
      if (!std::isnan(value)) known.push_back(value);
    const Eigen::Map<const Vector> values(known.data(), static_cast<Eigen::Index>(known.size()));
    squares += (values.array() - values.mean()).matrix().squaredNorm();
  }
  return std::sqrt(squares / measured.sampleCount());
}

}  // namespace

CalibrationResult calibrate(const HarmonicBalanceProblem& problem, std::vector<MeasuredMotion> measured,
                            const CalibrationOptions& options, base::ExecutionContext& context,
                            const std::function<void(const CalibrationIterate&)>& onIterate) {
  const base::Stopwatch watch;
  CalibrationResult result;
  auto model = std::make_shared<Model>(problem.model());
  model->parameters.clear();
  for (const int index : options.parameters)
    model->parameters.push_back(problem.model().parameters.at(static_cast<std::size_t>(index)));
  requireFixedRest(*model, measured);
  int otherUnknowns = 0;
  for (const MeasuredMotion& motion : measured) {
    result.sampleCount += motion.sampleCount();
    otherUnknowns += motion.unknownCount();
  }
  const auto count = static_cast<Eigen::Index>(model->parameters.size());
  if (const auto unknowns = static_cast<int>(count) + otherUnknowns; result.sampleCount <= unknowns)
    throw base::InputError("", std::to_string(result.sampleCount) + " measured values are too few for " +
                                   std::to_string(unknowns) + " unknowns, time offsets and places included.");
  result.before = model;

  CalibrationResiduals residuals(
      HarmonicBalanceProblem(model, problem.basis(), problem.drivePeriods(), problem.coordinateHarmonics()), measured,
      options.motion, context);
  result.report = residuals.begin();
  if (!result.report.converged()) {
    result.report.seconds = watch.seconds();
    return result;
  }
  const DesignBranch& branch = residuals.anyBranch();
  Vector variables = branch.firstVariables();
  Matrix jacobian;
  double sumOfSquares = 0;
  const auto accept = [&](const solvers::LeastSquaresIterate& iterate) {
    jacobian = iterate.jacobian;
    sumOfSquares = iterate.residuals.squaredNorm();
    if (iterate.iteration == 0)
      for (std::size_t i = 0; i < measured.size(); ++i) {
        CalibratedMotion& motion = result.motions.emplace_back();
        motion.before = residuals.fitOf(i);
        motion.zBefore = residuals.pointOf(i).motion.z;
      }
    CalibrationIterate at;
    at.iteration = iterate.iteration;
    at.values = branch.valuesOf(iterate.x);
    at.rootMeanSquare = std::sqrt(sumOfSquares / result.sampleCount);
    at.cosine = iterate.cosine;
    at.evaluations = iterate.evaluations;
    at.solves = residuals.solves();
    result.history.push_back(at);
    if (onIterate) onIterate(at);
  };
  result.report = solvers::fitWithinBounds(
      residuals, variables, Vector::Zero(count), Vector::Ones(count), options.fit, context, accept);
  result.failedFits = residuals.failures();
  if (!result.history.empty()) {
    for (std::size_t i = 0; i < measured.size(); ++i) {
      CalibratedMotion& motion = result.motions[i];
      motion.after = residuals.fitOf(i);
      motion.z = residuals.pointOf(i).motion.z;
      motion.timeOffset = motion.after.phase / measured[i].omega;
      motion.rootMeanSquare =
          std::sqrt(motion.after.residuals.squaredNorm() / static_cast<double>(motion.after.residuals.size()));
      motion.swing = swingOf(measured[i]);
      motion.serialCorrelation = serialCorrelation(measured[i], motion.after.residuals);
    }
    result.after = residuals.pointOf(0).problem->sharedModel();
    std::vector<char> held;
    for (const double variable : variables) {
      result.atBound.push_back(variable <= 0 ? -1 : variable >= 1 ? 1 : 0);
      held.push_back(result.atBound.back() != 0);
    }
    result.uncertainty = solvers::parameterUncertainty(jacobian * branch.ranges().cwiseInverse().asDiagonal(),
                                                       residuals.columnScales().cwiseQuotient(branch.ranges()), held,
                                                       sumOfSquares, otherUnknowns, options.level);
  }
  result.report.seconds = watch.seconds();
  return result;
}

}  // namespace pliant::harmonic
