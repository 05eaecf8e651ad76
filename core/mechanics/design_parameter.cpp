#include "core/mechanics/design_parameter.hpp"

namespace pliant::mechanics {

SparseMatrix ModelDerivative::mass() const { return {model_.coordinateCount(), model_.coordinateCount()}; }

Vector ModelDerivative::externalForce(math::Phases) const { return Vector::Zero(model_.coordinateCount()); }

Matrix ModelDerivative::gradient(const Matrix& x) const { return Matrix::Zero(x.rows(), x.cols()); }

Vector ModelDerivative::prescribed(math::Phases) const { return Vector::Zero(model_.coordinateCount()); }

}  // namespace pliant::mechanics
