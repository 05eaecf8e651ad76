#pragma once

#include <string>

#include "core/base/units.hpp"
#include "core/mechanics/model.hpp"

namespace pliant::mechanics {

/// What the equation of motion of one model loses or gains with a parameter p, all else fixed: free coordinates, phases
/// θ, ω. Kinds of parameters override what they touch; the rest does not depend on them. One thread at a time.
class ModelDerivative {
 public:
  explicit ModelDerivative(const Model& model) : model_(model) {}
  virtual ~ModelDerivative() = default;

  /// dM/dp, square over all coordinates.
  virtual SparseMatrix mass() const;
  /// d(f_ext)/dp at θ, on all coordinates (gravity's dependence on mass included).
  virtual Vector externalForce(math::Phases phases) const;
  /// d(∇E)/dp at some configurations `x` (one a row, all coordinates), like x.
  virtual Matrix gradient(const Matrix& x) const;
  /// How the coordinates that are not free move with p at θ; 0 for the free ones.
  virtual Vector prescribed(math::Phases phases) const;
  virtual double massDamping() const { return 0; }       ///< dD_α/dp
  virtual double stiffnessDamping() const { return 0; }  ///< dD_β/dp
  virtual double driveFrequency() const { return 0; }    ///< dω/dp, of the motion that is sought

 protected:
  const Model& model_;
};

/// A scalar of the model that a designer may change.
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
  /// The derivatives at `model`, which must outlive them.
  virtual std::unique_ptr<ModelDerivative> derivative(const Model& model) const = 0;
};

}  // namespace pliant::mechanics
