#include "core/cloth/cloth_contact.hpp"

#include <cmath>

#include "core/base/error.hpp"

namespace pliant::cloth {

Eigen::Matrix3Xd bodyPointsAt(const ClothProblem& problem, double time) {
  Eigen::Index count = 0;
  for (const Body& body : problem.bodies) count += body.points.cols();
  Eigen::Matrix3Xd points(3, count);
  count = 0;
  for (const Body& body : problem.bodies) {
    points.middleCols(count, body.points.cols()) = placementAt(body.path, time).apply(body.points, body.centre);
    count += body.points.cols();
  }
  return points;
}

Eigen::Matrix3Xd withBodies(const ClothProblem& problem, const Eigen::Matrix3Xd& positions, double time) {
  const Eigen::Matrix3Xd bodies = bodyPointsAt(problem, time);
  Eigen::Matrix3Xd all(3, positions.cols() + bodies.cols());
  all << positions, bodies;
  return all;
}

std::shared_ptr<mechanics::ContactBarrier> makeContactBarrier(const ClothProblem& problem) {
  if (problem.bodies.empty() && !problem.selfContact) return nullptr;
  const int nodes = problem.model->nodeCount();
  mechanics::ContactGeometry geometry;
  geometry.selfContact = problem.selfContact;
  for (const SheetTriangle& triangle : problem.sheet.triangles) geometry.triangles.push_back(triangle.nodes);
  geometry.radii.assign(static_cast<std::size_t>(nodes), 0);
  geometry.bodies.assign(static_cast<std::size_t>(nodes), 0);
  int first = nodes, number = 0;
  for (const Body& body : problem.bodies) {
    const int count = static_cast<int>(body.points.cols());
    for (const auto& [a, b, c] : body.triangles) geometry.triangles.push_back({first + a, first + b, first + c});
    for (const auto& [a, b] : body.edges) geometry.edges.push_back({first + a, first + b});
    if (body.triangles.empty() && body.edges.empty())
      for (int i = 0; i < count; ++i) geometry.points.push_back(first + i);
    geometry.radii.insert(geometry.radii.end(), static_cast<std::size_t>(count), body.radius);
    geometry.bodies.insert(geometry.bodies.end(), static_cast<std::size_t>(count), ++number);
    first += count;
  }
  const double range = problem.contactDistance;
  if (!(std::isfinite(range) && range > 0)) throw base::InputError("", "the contact distance must be a number above 0");
  // Half-way into the range, where the barrier falls by 1.193 range a metre, a pair pushes ten times as hard as a node
  // weighs.
  const double gravity = 9.81;
  const double stiffness = 10 * problem.sheet.masses.mean() * gravity / (1.193 * range);
  Eigen::Matrix3Xd rest(3, first);
  rest << problem.model->restPositions.reshaped(3, nodes), bodyPointsAt(problem, 0);
  return std::make_shared<mechanics::ContactBarrier>(
      std::move(geometry), rest, mechanics::ContactOptions{.range = range, .stiffness = stiffness, .separation = 0});
}

void checkContactOptions(std::string_view limitMethod, ProjectionNorm norm) {
  if (limitMethod != "cone" && limitMethod != "none")
    throw base::InputError("", "with bodies or self-contact limits are kept by the method \"cone\" alone, not by \"" +
                                   std::string(limitMethod) + "\"");
  if (norm != ProjectionNorm::mass)
    throw base::InputError("", "with bodies or self-contact projections are by the norm \"mass\" alone");
}

}  // namespace pliant::cloth
