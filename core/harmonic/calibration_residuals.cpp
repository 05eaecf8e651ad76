#include "core/harmonic/calibration_residuals.hpp"

#include <algorithm>
#include <numbers>

#include "core/harmonic/path_length.hpp"
#include "core/harmonic/response_sensitivity.hpp"

namespace pliant::harmonic {

namespace {

/// How the coefficients of a coordinate that is not free change with a parameter.
Vector prescribedCoefficients(const HarmonicBalanceProblem& problem, const mechanics::ModelDerivative& derivative,
                              int coordinate) {
  const math::HarmonicBasis& basis = problem.basis();
  Vector samples(basis.samples());
  for (int i = 0; i < basis.samples(); ++i)
    samples[i] = derivative.prescribed(2 * std::numbers::pi * i / basis.samples())[coordinate];
  return basis.analysis() * samples;
}

/// The change of what is measured with a parameter, as coefficients of each measured coordinate.
Matrix coefficientChange(const MeasuredMotion& measured, const HarmonicBalanceProblem& problem,
                         const ResponseSensitivity& sensitivity, Eigen::Index parameter) {
  const Model& model = problem.model();
  const Eigen::Index size = problem.basis().size();
  Matrix change(size, static_cast<Eigen::Index>(measured.coordinates.size()));
  std::unique_ptr<mechanics::ModelDerivative> derivative;
  for (std::size_t c = 0; c < measured.coordinates.size(); ++c) {
    const int coordinate = measured.coordinates[c].node * model.dimension + measured.coordinates[c].axis;
    const int free = model.dofs.freeIndex[static_cast<std::size_t>(coordinate)];
    auto column = change.col(static_cast<Eigen::Index>(c));
    if (free >= 0) {
      column = sensitivity.derivative().col(parameter).segment(free * size, size);
      continue;
    }
    if (!derivative) derivative = model.parameters[static_cast<std::size_t>(parameter)]->derivative(model);
    column = prescribedCoefficients(problem, *derivative, coordinate);
  }
  return change;
}

}  // namespace

CalibrationResiduals::CalibrationResiduals(const HarmonicBalanceProblem& problem, std::vector<MeasuredMotion> measured,
                                           const PeriodicMotionOptions& motion, base::ExecutionContext& context) {
  for (MeasuredMotion& each : measured) {
    auto same = std::find_if(
        frequencies_.begin(), frequencies_.end(), [&](const auto& f) { return f->options.omega == each.omega; });
    if (same == frequencies_.end()) {
      auto frequency = std::make_unique<Frequency>();
      frequency->options.omega = each.omega;
      frequency->options.motion = motion;
      for (std::size_t i = 0; i < problem.model().parameters.size(); ++i)
        frequency->options.parameters.push_back(static_cast<int>(i));
      frequency->branch = std::make_unique<DesignBranch>(problem, frequency->options, context);
      same = frequencies_.insert(frequencies_.end(), std::move(frequency));
    }
    const auto index = static_cast<std::size_t>(same - frequencies_.begin());
    parts_.push_back({MotionComparison(std::move(each), problem.basis().harmonics()), index, {}});
  }
}

base::SolverReport CalibrationResiduals::begin() {
  base::SolverReport report;
  for (auto& frequency : frequencies_) {
    frequency->last = frequency->branch->begin();
    frequency->base = frequency->last;
    report = frequency->last.motion.report;
    if (!report.converged()) break;
  }
  return report;
}

bool CalibrationResiduals::evaluate(const Vector& variables, Vector& residuals, Matrix* jacobian) {
  for (auto& frequency : frequencies_) {
    DesignPoint& last = frequency->last;
    if (variables == last.variables) continue;
    if ((variables - frequency->base.variables).norm() < (variables - last.variables).norm()) last = frequency->base;
    if (!frequency->branch->follow(last, variables)) {
      ++failures_;
      return false;
    }
  }
  Eigen::Index rows = 0;
  for (Part& part : parts_) {
    part.fit = part.comparison.compare(coefficientsOf(part, frequencies_[part.frequency]->last));
    rows += part.fit.residuals.size();
  }
  residuals.resize(rows);
  Eigen::Index row = 0;
  for (const Part& part : parts_) {
    residuals.segment(row, part.fit.residuals.size()) = part.fit.residuals;
    row += part.fit.residuals.size();
  }
  return !jacobian || linearize(*jacobian);
}

bool CalibrationResiduals::linearize(Matrix& jacobian) {
  Eigen::Index rows = 0;
  for (const Part& part : parts_) rows += part.fit.residuals.size();
  const Vector& ranges = anyBranch().ranges();
  jacobian.resize(rows, ranges.size());
  Vector squares = Vector::Zero(ranges.size());
  for (std::size_t f = 0; f < frequencies_.size(); ++f) {
    const DesignPoint& point = frequencies_[f]->last;
    const ResponseSensitivity sensitivity(*point.problem, point.motion);
    if (!sensitivity.regular()) return false;
    Eigen::Index row = 0;
    for (const Part& part : parts_) {
      const Eigen::Index size = part.fit.residuals.size();
      for (Eigen::Index p = 0; part.frequency == f && p < ranges.size(); ++p) {
        const Matrix change = ranges[p] * coefficientChange(part.comparison.measured(), *point.problem, sensitivity, p);
        jacobian.col(p).segment(row, size) = part.comparison.derivative(part.fit, change);
        squares[p] += part.comparison.derivative(part.fit, change, false).squaredNorm();
      }
      row += size;
    }
  }
  scales_ = squares.cwiseSqrt();
  for (auto& frequency : frequencies_) frequency->base = frequency->last;
  return true;
}

Matrix CalibrationResiduals::coefficientsOf(const Part& part, const DesignPoint& point) {
  const MeasuredMotion& measured = part.comparison.measured();
  const Model& model = point.problem->model();
  Matrix result(point.problem->basis().size(), static_cast<Eigen::Index>(measured.coordinates.size()));
  for (std::size_t c = 0; c < measured.coordinates.size(); ++c) {
    const MeasuredCoordinate& coordinate = measured.coordinates[c];
    auto column = result.col(static_cast<Eigen::Index>(c));
    column = nodeCoefficients(*point.problem, point.motion.z, coordinate.node).col(coordinate.axis);
    if (measured.meaning == MeasuredValue::displacement)
      column[0] -= model.restPositions[coordinate.node * model.dimension + coordinate.axis];
  }
  return result;
}

MotionFit CalibrationResiduals::fitOf(std::size_t measured) const {
  const Part& part = parts_[measured];
  return part.comparison.compare(coefficientsOf(part, pointOf(measured)));
}

int CalibrationResiduals::solves() const {
  int count = 0;
  for (const auto& frequency : frequencies_) count += frequency->branch->solves() + 1;
  return count;
}

}  // namespace pliant::harmonic
