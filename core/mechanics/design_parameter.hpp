#pragma once

#include <string>

#include "core/base/units.hpp"
#include "core/mechanics/model.hpp"

namespace pliant::mechanics {

/// A scalar of the model that a designer may change, with the derivatives of the equation of motion that sensitivity
/// analysis needs. Kinds override what they touch; whatever they do not override does not depend on them.
class DesignParameter {
 public:
  virtual ~DesignParameter() = default;

  virtual std::string name() const = 0;
  virtual base::Dimension dimension() const = 0;
  /// JSON pointer of the value in the scene, such as "/point_masses/0/mass".
  virtual std::string pointer() const = 0;
  virtual double value(const Model& model) const = 0;
  virtual double minimum(const Model& model) const = 0;
  virtual double maximum(const Model& model) const = 0;

  /// The model with another value of this parameter.
  virtual Model withValue(const Model& model, double value) const = 0;

  /// dM/dp, square over all coordinates.
  virtual SparseMatrix massDerivative(const Model& model) const;
  /// d(f_ext)/dp at τ, on all coordinates (gravity's dependence on mass included).
  virtual Vector externalForceDerivative(const Model& model, double tau) const;
  /// d(∇E)/dp at positions x, on all coordinates.
  virtual Vector gradientDerivative(const Model& model, const Vector& x) const;
};

}  // namespace pliant::mechanics
