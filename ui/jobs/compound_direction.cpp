#include "ui/jobs/compound_direction.hpp"

#include <algorithm>
#include <cmath>

#include "core/harmonic/amplitude.hpp"

namespace pliant::jobs {

using harmonic::Vector;

namespace {

constexpr double difference = 1e-5;  // of the motion's own size

}  // namespace

CompoundGoal amplitudeGoal(const QString& name, std::vector<int> nodes) {
  return {name, [nodes = std::move(nodes)](const harmonic::HarmonicBalanceProblem& problem, const Vector& z) {
            double sum = 0;
            for (const int node : nodes) sum += harmonic::amplitude(problem, z, node).pathLength;
            return sum;
          }};
}

CompoundDirection::CompoundDirection(const harmonic::HarmonicBalanceProblem& problem, const Vector& z,
                                     const harmonic::ResponseSensitivity& sensitivity, const CompoundGoal& goal,
                                     std::vector<MovableParameter> parameters)
    : parameters_(std::move(parameters)) {
  const auto count = static_cast<Eigen::Index>(parameters_.size());
  towards_ = Vector::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const MovableParameter& parameter = parameters_[static_cast<std::size_t>(i)];
    const auto column = sensitivity.derivative().col(parameter.index);
    if (column.isZero(0)) continue;
    // Of the very measure that is shown, along the predicted motion, as for single parameters.
    const double step = difference * std::max(z.norm(), 1e-12) / column.norm();
    const double slope =
        (goal.measure(problem, z + step * column) - goal.measure(problem, z - step * column)) / (2 * step);
    towards_[i] = (goal.wantsMore ? 1 : -1) * slope * (parameter.maximum - parameter.minimum);
  }
  away_ = stepsFor(-1);
  towards_ = stepsFor(1);
  isEmpty_ = !(towards_.size() > 0 && (!towards_.isZero(0) || !away_.isZero(0)));
}

Vector CompoundDirection::stepsFor(double sign) const {
  Vector steps = sign * towards_;
  for (Eigen::Index i = 0; i < steps.size(); ++i) {
    const MovableParameter& parameter = parameters_[static_cast<std::size_t>(i)];
    if ((steps[i] > 0 && parameter.value >= parameter.maximum) ||
        (steps[i] < 0 && parameter.value <= parameter.minimum))
      steps[i] = 0;
  }
  const double largest = steps.size() > 0 ? steps.cwiseAbs().maxCoeff() : 0;
  return largest > 0 ? Vector(steps / largest) : Vector(Vector::Zero(steps.size()));
}

std::map<std::string, double> CompoundDirection::valuesAt(double share) const {
  std::map<std::string, double> values;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const MovableParameter& parameter = parameters_[i];
    const double step = (share >= 0 ? towards_ : away_)[static_cast<Eigen::Index>(i)];
    if (step == 0) continue;
    values[parameter.pointer] =
        std::clamp(parameter.value + std::abs(share) * step * (parameter.maximum - parameter.minimum),
                   parameter.minimum, parameter.maximum);
  }
  return values;
}

Vector CompoundDirection::way(double sign, Eigen::Index count) const {
  Vector way = Vector::Zero(count);
  const Vector& steps = sign >= 0 ? towards_ : away_;
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    way[parameters_[i].index] = steps[static_cast<Eigen::Index>(i)] * (parameters_[i].maximum - parameters_[i].minimum);
  return way;
}

std::map<std::string, double> CompoundDirection::steps() const {
  std::map<std::string, double> steps;
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    steps[parameters_[i].pointer] = towards_[static_cast<Eigen::Index>(i)];
  return steps;
}

}  // namespace pliant::jobs
