#pragma once

#include <memory>
#include <optional>

#include "core/base/execution_context.hpp"
#include "core/cloth/cloth_problem.hpp"
#include "core/geometry/mesh_animation.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/harmonic/harmonic_balance_problem.hpp"
#include "core/scene/cloth_result.hpp"

namespace pliant::scene {

/// The triangles of a cloth where one of its frames has them.
geometry::SurfaceMesh clothMesh(const cloth::ClothProblem& problem, const ClothFrame& frame);

/// All frames of a cloth at their times; none if it is cancelled.
std::optional<geometry::MeshAnimation> clothAnimation(const cloth::ClothProblem& problem,
                                                      const std::vector<std::shared_ptr<const ClothFrame>>& frames,
                                                      base::ExecutionContext& context);

/// One period of a motion in `steps` equal steps that take `seconds` in all. It ends as it begins, so that it can be
/// repeated. Throws base::InputError (location empty) for a model without triangles, or steps or seconds that are not
/// above 0.
geometry::MeshAnimation periodAnimation(const harmonic::HarmonicBalanceProblem& problem, const mechanics::Vector& z,
                                        int steps, double seconds);

/// Of an animation of this length: 30 a second.
int animationSteps(double seconds);

}  // namespace pliant::scene
