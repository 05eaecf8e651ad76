#pragma once

#include <optional>
#include <string>

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// Where two elements of a cell are nearest to each other at rest.
struct NearestElements {
  int a = 0, b = 0;
  std::array<int, 2> shift{};  ///< lattice vectors by which b is moved
  double gap = 0;              ///< [m]; negative: they overlap
  Eigen::Vector3d place;       ///< midway between the surfaces [m]
};

/// A link that is not as the material is meant to have it.
struct ChangedLink {
  Link link;      ///< with the number that is declared
  int found = 0;  ///< what it is at rest
};

/// What can be told of a cell at rest before anything is computed with it.
struct CellInspection {
  std::optional<NearestElements> nearest;  ///< none if all are farther apart than `reach`
  double reach = 0;                        ///< [m]
  double radius = 0;                       ///< the smallest of all pieces [m]
  int declaredLinks = 0;
  /// Where elements overlap they cannot be told, and none is listed.
  std::vector<ChangedLink> changedLinks;
  /// What is wrong, one sentence for a person who counts elements from 1; empty if checkCell would accept the cell.
  std::string fault;

  bool overlaps() const { return nearest && !(nearest->gap > 0); }
};

/// Inspects what checkCell checks, and measures the smallest gap of up to `reachInRadii` of the smallest radius. A
/// shape or a lattice that is none is a fault too: nothing is thrown.
CellInspection inspectCell(const UnitCell& cell, double reachInRadii = 5);

}  // namespace pliant::interlock
