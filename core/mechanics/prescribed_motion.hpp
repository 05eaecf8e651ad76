#pragma once

#include <memory>
#include <vector>

#include "core/mechanics/model.hpp"

namespace pliant::mechanics {

/// rest + direction * signal(τ); `direction` as given, the signal in metres.
std::shared_ptr<const PrescribedMotion> makeTranslation(const std::vector<int>& nodes, Vector direction,
                                                        PeriodicSignal signal);

/// Rotation by the angle signal(τ) [rad] about an axis through `center` (in 2 dimensions the axis is ignored: z).
std::shared_ptr<const PrescribedMotion> makeRotation(const std::vector<int>& nodes, Vector center, Eigen::Vector3d axis,
                                                     PeriodicSignal signal);

/// A rod's frame (see RodNetwork) of the given frameLength, whose three coordinates start at `firstCoordinate`, turned
/// by the angle signal(τ) [rad] about an axis. Throws base::InputError unless the angle stays below 180°.
std::shared_ptr<const PrescribedMotion> makeFrameRotation(int firstCoordinate, double frameLength, Eigen::Vector3d axis,
                                                          PeriodicSignal signal);

/// A scalar coordinate by the angle signal(τ) [rad], of which it is `lever` [m] times.
std::shared_ptr<const PrescribedMotion> makeScalarDrive(int coordinate, double lever, PeriodicSignal signal);

}  // namespace pliant::mechanics
