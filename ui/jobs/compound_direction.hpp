#pragma once

#include <QString>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/harmonic/response_sensitivity.hpp"

namespace pliant::jobs {

/// A number of a motion that several parameters are to change together [m].
struct CompoundGoal {
  QString name;
  std::function<double(const harmonic::HarmonicBalanceProblem&, const harmonic::Vector& z)> measure;
  bool wantsMore = true;  ///< of it; else less
};

/// The sum of these nodes' path lengths.
CompoundGoal amplitudeGoal(const QString& name, std::vector<int> nodes);

/// One parameter that may be moved.
struct MovableParameter {
  std::string pointer;
  int index = 0;  ///< in `Model::parameters`
  double value = 0, minimum = 0, maximum = 0;
};

/// The way on which a goal changes fastest, counting each parameter in parts of its range: the gradient of (2.4.5), by
/// the sensitivity of a motion, scaled so that the parameter that changes most crosses its range. What is at a bound
/// and would leave it stays (thesis 2.4.2: compound variables along the gradient of selected objectives).
class CompoundDirection {
 public:
  CompoundDirection() = default;
  CompoundDirection(const harmonic::HarmonicBalanceProblem& problem, const harmonic::Vector& z,
                    const harmonic::ResponseSensitivity& sensitivity, const CompoundGoal& goal,
                    std::vector<MovableParameter> parameters);

  /// Nothing can be moved, or nothing that is moved matters.
  bool isEmpty() const { return isEmpty_; }
  /// By pointer, within the bounds; `share` in [-1, 1] of the way towards the goal or away from it.
  std::map<std::string, double> valuesAt(double share) const;
  /// The whole way towards the goal (`sign` 1) or away from it (-1), bounds aside, by index in `Model::parameters`, of
  /// which there are `count`.
  harmonic::Vector way(double sign, Eigen::Index count) const;
  /// Parts of each parameter's range that a step towards the goal takes, of [-1, 1], by pointer.
  std::map<std::string, double> steps() const;

 private:
  harmonic::Vector stepsFor(double sign) const;

  std::vector<MovableParameter> parameters_;
  harmonic::Vector towards_, away_;  ///< parts of ranges
  bool isEmpty_ = true;
};

}  // namespace pliant::jobs
