#include "core/mechanics/design_parameter.hpp"

namespace pliant::mechanics {

SparseMatrix DesignParameter::massDerivative(const Model& model) const {
  return {model.coordinateCount(), model.coordinateCount()};
}

Vector DesignParameter::externalForceDerivative(const Model& model, double) const {
  return Vector::Zero(model.coordinateCount());
}

Vector DesignParameter::gradientDerivative(const Model& model, const Vector&) const {
  return Vector::Zero(model.coordinateCount());
}

}  // namespace pliant::mechanics
