#pragma once

#include <memory>
#include <string_view>

#include "core/cloth/cloth_problem.hpp"
#include "core/mechanics/contact_barrier.hpp"

namespace pliant::cloth {

/// Of the points of all bodies at `time`, one body after the other (3 x points) [m].
Eigen::Matrix3Xd bodyPointsAt(const ClothProblem& problem, double time);

/// Positions of the nodes, followed by the bodies' points: what a contact barrier counts as its nodes [m].
Eigen::Matrix3Xd withBodies(const ClothProblem& problem, const Eigen::Matrix3Xd& positions, double time);

/// The barrier between the sheet, the bodies and, if the problem says so, the sheet itself; null if there is neither a
/// body nor self-contact. Half-way into the contact distance a pair pushes ten times as hard as a node weighs. Throws
/// base::InputError (location empty) if the contact distance is not above 0.
std::shared_ptr<mechanics::ContactBarrier> makeContactBarrier(const ClothProblem& problem);

/// Throws base::InputError (location empty) for what cannot be kept together with contact: a method other than "cone"
/// or "none", or a norm that does not weigh by mass.
void checkContactOptions(std::string_view limitMethod, ProjectionNorm norm);

}  // namespace pliant::cloth
