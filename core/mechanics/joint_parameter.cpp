#include "core/mechanics/joint_parameter.hpp"

#include <algorithm>

namespace pliant::mechanics {

namespace {

/// What changes of one group.
struct GroupChange {
  std::vector<const JointParameter*> members;
  std::vector<double> values;
};

}  // namespace

Model withParameterValues(const Model& model, const std::vector<std::shared_ptr<const DesignParameter>>& parameters,
                          const Vector& values) {
  Model changed = model;
  std::vector<GroupChange> groups;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double value = values[static_cast<Eigen::Index>(i)];
    const auto* joint = dynamic_cast<const JointParameter*>(parameters[i].get());
    if (value == parameters[i]->value(model)) continue;
    if (!joint) {
      changed = parameters[i]->withValue(changed, value);
      continue;
    }
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const GroupChange& g) { return g.members.front()->group() == joint->group(); });
    if (group == groups.end()) group = groups.insert(groups.end(), GroupChange{});
    group->members.push_back(joint);
    group->values.push_back(value);
  }
  for (const GroupChange& group : groups)
    changed = group.members.front()->withJointValues(changed, group.members, group.values);
  return changed;
}

}  // namespace pliant::mechanics
