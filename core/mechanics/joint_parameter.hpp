#pragma once

#include <vector>

#include "core/mechanics/design_parameter.hpp"

namespace pliant::mechanics {

/// A parameter that is changed together with others of its group at the price of one.
class JointParameter : public DesignParameter {
 public:
  /// The same for all of a group.
  virtual const void* group() const = 0;
  /// The model with other values of `members`, which are of this group.
  virtual Model withJointValues(const Model& model, const std::vector<const JointParameter*>& members,
                                const std::vector<double>& values) const = 0;

  Model withValue(const Model& model, double value) const final { return withJointValues(model, {this}, {value}); }
};

/// The model with other values of some of its parameters: `values[i]` for `parameters[i]`. Each group is changed once.
Model withParameterValues(const Model& model, const std::vector<std::shared_ptr<const DesignParameter>>& parameters,
                          const Vector& values);

}  // namespace pliant::mechanics
