#pragma once

#include "core/interlock/cell_contact.hpp"
#include "core/interlock/sphere_mesh.hpp"

namespace pliant::interlock {

/// A rotation or reflection in the plane, perhaps with the plane turned over, that maps a material at rest onto itself
/// after a translation.
struct CellSymmetry {
  Eigen::Matrix3d linear;  ///< orthogonal; leaves the plane z = 0 where it is
  Eigen::Vector3d offset;  ///< [m]
  /// Where an element comes to lie: on an element moved by whole lattice vectors, with its shape mapped by `shape`.
  struct Image {
    int element;
    std::array<int, 2> shift;
    Eigen::Matrix3d shape;  ///< orthogonal, from the coordinates of one shape to those of the other
  };
  std::vector<Image> images;  ///< one an element

  /// What it does to strain coordinates (3 x 3, orthogonal): a cell that can be strained by ε can be by this times ε.
  Eigen::Matrix3d strainMap() const;
  /// The state mapped likewise: all gaps are the same.
  CellState mapped(const UnitCell& cell, const CellState& state) const;
};

/// All symmetries whose linear part maps each lattice vector to a sum of at most one of each, the identity first.
/// Shapes count as the same if they are to `tolerance` times their size.
std::vector<CellSymmetry> symmetriesOf(const UnitCell& cell, double tolerance = 1e-6);

/// Directions of which symmetries make one from the other.
struct DirectionOrbits {
  /// For each direction the first one of its orbit, and the symmetry that makes it from that one.
  std::vector<int> representative, symmetry;
  int count = 0;  ///< of orbits
};

/// Symmetries that map a direction to none of the mesh are left out there.
DirectionOrbits orbitsOf(const SphereMesh& mesh, const std::vector<CellSymmetry>& symmetries);

/// The icosphere turned such that as many of the symmetries as possible map its directions to one another.
SphereMesh symmetricIcosphere(int subdivisions, const std::vector<CellSymmetry>& symmetries);

}  // namespace pliant::interlock
