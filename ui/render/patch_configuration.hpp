#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/bending_result.hpp"

namespace pliant::render {

/// A finite patch in its equilibrium, and what holds it.
struct PatchConfiguration {
  std::shared_ptr<const interlock::UnitCell> patch;
  interlock::CellState state;
  std::vector<interlock::CellContactForce> contacts;
  std::optional<Eigen::Vector3d> curvature;  ///< of the paraboloid on which elements lie [1/m]; none: they are free
  std::vector<int> clamped;                  ///< elements that do not move
  std::optional<Eigen::Vector3d> gravity;    ///< that pulls on the others [m/s²]
};

/// What studies found. Null if the study ended before elements had places.
std::shared_ptr<const PatchConfiguration> patchConfiguration(const scene::BendingTestResult& result);
std::shared_ptr<const PatchConfiguration> patchConfiguration(const scene::GravityBendingResult& result);
/// Of one limit of the boundary, of which contacts are found anew, which takes a while.
std::shared_ptr<const PatchConfiguration> patchConfiguration(const scene::BendingBoundaryResult& result, int state);

/// The numbers that belong to it, in lines: curvatures, radius, what holds the patch, and what that holds for.
std::string patchCaption(const scene::BendingTestResult& result);
std::string patchCaption(const scene::GravityBendingResult& result);
std::string patchCaption(const scene::BendingBoundaryResult& result, int state);

/// "k_xx 12.3 1/m,  k_yy −4 1/m,  k_xy 0 1/m" and the principal curvatures that they mean.
std::string curvatureText(const Eigen::Vector3d& tensor);

}  // namespace pliant::render
