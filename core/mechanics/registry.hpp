#pragma once

#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/mechanics/design_parameter.hpp"
#include "core/mechanics/model.hpp"

namespace pliant::mechanics {

/// Every kind of energy and of design parameter, each with a random example, so that one test checks the derivatives
/// of all of them against finite differences.
struct EnergyKind {
  std::string name;
  /// A model with this energy alone, at a random rest shape.
  std::function<Model(std::mt19937&)> example;
};
const std::vector<EnergyKind>& energyKinds();

struct ParameterKind {
  std::string name;
  /// A model that has a parameter of this kind as its first.
  std::function<Model(std::mt19937&)> example;
  /// Likewise, with periodic motions: see driven_examples.hpp.
  std::function<Model(std::mt19937&)> drivenExample;
};
const std::vector<ParameterKind>& parameterKinds();

}  // namespace pliant::mechanics
