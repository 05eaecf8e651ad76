#pragma once

#include <limits>

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// A force and a spring on one place X of an element, or of one of its images: adds
///   -force · (X - X_0) + S(|X - target|)
/// to the objective, X_0 being where it was before. S is ½ spring d² as long as that pulls no harder than `strongest`,
/// and goes on straight from there (Huber 1964), so that a target far away pulls with a force of known size. The first
/// element's origin keeps its place, since a cell as a whole has none.
struct ElementPull {
  int element = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [1/m]
  double spring = 0;                                 ///< [1/m²]
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< [m]
  /// Of the place, from the element's origin, in its shape's coordinates [m].
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();
  /// Lattice vectors by which the image is moved. Of the first element's origin, which stays, any fractions are places
  /// that the lattice alone carries along.
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double strongest = std::numeric_limits<double>::infinity();  ///< [1/m]
};

/// X [m].
Eigen::Vector3d placeOf(const UnitCell& cell, const CellState& state, const ElementPull& pull);

/// What it adds to the objective, `before` being X_0.
double energyOf(const UnitCell& cell, const CellState& state, const ElementPull& pull, const Eigen::Vector3d& before);

/// Adds its derivatives by the coordinates of a velocity (see `moved`); null where not wanted.
void addDerivatives(const UnitCell& cell, const CellState& state, const ElementPull& pull, Eigen::VectorXd& gradient,
                    Eigen::MatrixXd* hessian);

}  // namespace pliant::interlock
