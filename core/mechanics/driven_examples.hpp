#pragma once

#include <random>

#include "core/mechanics/model.hpp"

namespace pliant::mechanics {

/// Models with periodic motions at 3 rad/s, one for each kind of design parameter, which is their first: two nodes held
/// by hardening springs, pulled, damped and shaken by a third. Every probe moves.
Model drivenPointMassExample(std::mt19937& random);
Model drivenFamilyExample(std::mt19937& random);
Model drivenStiffnessFactorExample(std::mt19937& random);

}  // namespace pliant::mechanics
