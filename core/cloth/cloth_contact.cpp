#include "core/cloth/cloth_contact.hpp"

#include "core/base/error.hpp"

namespace pliant::cloth {

Eigen::Matrix3Xd bodyPointsAt(const ClothProblem& problem, double time) {
  return mechanics::bodyPointsAt(problem.bodies, time);
}

Eigen::Matrix3Xd withBodies(const ClothProblem& problem, const Eigen::Matrix3Xd& positions, double time) {
  const Eigen::Matrix3Xd bodies = bodyPointsAt(problem, time);
  Eigen::Matrix3Xd all(3, positions.cols() + bodies.cols());
  all << positions, bodies;
  return all;
}

std::shared_ptr<mechanics::ContactBarrier> makeContactBarrier(const ClothProblem& problem) {
  mechanics::SheetContact contact{{}, problem.bodies, problem.contactDistance, problem.selfContact};
  for (const SheetTriangle& triangle : problem.sheet.triangles) contact.triangles.push_back(triangle.nodes);
  constexpr double gravity = 9.81;
  return mechanics::makeSheetContact(contact, problem.model->restPositions.reshaped(3, problem.model->nodeCount()),
                                     problem.sheet.masses.mean() * gravity);
}

void checkContactOptions(std::string_view limitMethod, ProjectionNorm norm) {
  if (limitMethod != "cone" && limitMethod != "none")
    throw base::InputError("", "with bodies or self-contact limits are kept by the method \"cone\" alone, not by \"" +
                                   std::string(limitMethod) + "\"");
  if (norm != ProjectionNorm::mass)
    throw base::InputError("", "with bodies or self-contact projections are by the norm \"mass\" alone");
}

}  // namespace pliant::cloth
