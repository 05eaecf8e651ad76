#include "core/scene/motion_animation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/scene/model_builder.hpp"

namespace pliant::scene {

geometry::SurfaceMesh clothMesh(const cloth::ClothProblem& problem, const ClothFrame& frame) {
  mechanics::Vector positions = problem.model->restPositions;
  positions.head(frame.positions.size()) = frame.positions.reshaped();
  return surfaceAt(*problem.model, positions);
}

std::optional<geometry::MeshAnimation> clothAnimation(const cloth::ClothProblem& problem,
                                                      const std::vector<std::shared_ptr<const ClothFrame>>& frames,
                                                      base::ExecutionContext& context) {
  geometry::MeshAnimation animation;
  for (const auto& frame : frames) {
    if (context.cancelRequested()) return std::nullopt;
    geometry::SurfaceMesh mesh = clothMesh(problem, *frame);
    animation.triangles = std::move(mesh.triangles);
    animation.frames.push_back(std::move(mesh.points));
    animation.times.push_back(frame->time);
  }
  return animation;
}

geometry::MeshAnimation periodAnimation(const harmonic::HarmonicBalanceProblem& problem, const mechanics::Vector& z,
                                        int steps, double seconds) {
  if (steps < 1 || !(seconds > 0 && std::isfinite(seconds)))
    throw base::InputError("", "An animation needs at least one step, and a length above 0.");
  const bool repeats = !problem.basis().hasTwoFrequencies();
  geometry::MeshAnimation animation;
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    geometry::SurfaceMesh mesh =
        surfaceAt(problem.model(), problem.configurationAt(z, i == steps && repeats ? 0 : 2 * std::numbers::pi * part));
    if (mesh.triangles.empty()) throw base::InputError("", "The scene has no triangles to animate.");
    animation.triangles = std::move(mesh.triangles);
    animation.frames.push_back(std::move(mesh.points));
    animation.times.push_back(part * seconds);
  }
  return animation;
}

int animationSteps(double seconds) {
  constexpr double perSecond = 30, most = 10'000;
  return static_cast<int>(std::clamp(std::round(perSecond * seconds), 1.0, most));
}

}  // namespace pliant::scene
