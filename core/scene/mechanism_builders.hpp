#pragma once

#include <string>
#include <vector>

#include "core/mechanics/periodic_signal.hpp"
#include "core/scene/element_builders.hpp"

namespace pliant::scene {

/// Elements of compliant mechanisms (ElementBuilder).
void addLink(const ElementContext& context);
void addRigidAngle(const ElementContext& context);

/// What else of a mechanism is built from: the normalised scene, its geometry, and the model so far.
struct MechanismContext {
  const Json& scene;
  const std::vector<PlacedGeometry>& geometries;
  mechanics::Model& model;
};

/// Springs of type "local" and "torsion", and drives of type "servo", which must come before the elements because they
/// append a scalar coordinate. All throw base::InputError.
void addLocalSpring(const MechanismContext& context, const Json& entry, const std::string& pointer);
void addTorsionSpring(const MechanismContext& context, const Json& entry, const std::string& pointer);
void addServo(const MechanismContext& context, const Json& entry, const std::string& pointer,
              const mechanics::PeriodicSignal& angle);

}  // namespace pliant::scene
