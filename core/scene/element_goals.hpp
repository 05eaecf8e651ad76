#pragma once

#include "core/interlock/deformation_test.hpp"
#include "core/interlock/element_design.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// A wanted limit, and how a person would name it.
struct ElementGoal {
  enum class Kind { stretch, compression, ray };
  Kind kind = Kind::stretch;
  double angle = 0;                                     ///< of a direction [rad]
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< of a ray from rest, in strain coordinates
  interlock::LimitGoal limit;

  /// As it is shown: a compression has negative strain.
  double shown(double limitValue) const { return kind == Kind::compression ? -limitValue : limitValue; }
  std::string_view name() const;
};

/// The goals of a normalised study "element_design" at `pointer`. Throws base::InputError: none of them, a region
/// without rest inside, or a file that cannot be read.
std::vector<ElementGoal> elementGoals(const Scene& scene, const Json& options, const std::string& pointer,
                                      interlock::Lateral lateral);

}  // namespace pliant::scene
