#pragma once

#include <functional>
#include <optional>

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// How a shape, cut into parts, changes with one number of it, by one unit of that number. Curves are finite Fourier
/// series, so that the rate of a curve is a curve: its place at t is that of c(t) alone, with t kept.
struct PartsRate {
  std::vector<ClosedCurve> curves;  ///< as ElementParts::curves
  Eigen::Matrix3Xd corners;         ///< as ElementParts::corners
  Eigen::VectorXd radii;            ///< of the parts [m]
  Eigen::VectorXd begins, ends;     ///< of the parts that are arcs
};

/// The same of a cell.
struct CellRate {
  std::vector<PartsRate> shapes;
  Eigen::Matrix2d lattice;     ///< [m]
  Eigen::Matrix3Xd positions;  ///< of the elements at rest [m]
  Eigen::Matrix3Xd turns;      ///< rotation vectors of the elements at rest, from the left
  double radius = 0;           ///< UnitCell::smallestRadius [m]
};

/// A cell by its numbers. May throw base::InputError.
using CellFunction = std::function<UnitCell(const Eigen::VectorXd&)>;

/// The rate with the number `index` at `values`, by central differences of sixth order of what `build` makes: `step` is
/// the first that is tried, and a hundredth of the scale on which the geometry changes. Shapes are made of a
/// few sines and products, without any iteration, so that these differences are right to about 10⁻¹² of the size of the
/// numbers whatever `build` does; all that contact makes of them is exact. None where the cell falls into other parts
/// on the two sides, as where an elliptic wire takes another number of discs, or cannot be built.
std::optional<CellRate> rateOf(const CellFunction& build, const Eigen::VectorXd& values, int index, double step);

}  // namespace pliant::interlock
