#pragma once

#include "core/base/units.hpp"
#include "core/interlock/cell_rate.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// A real number of an entry of "interlocking_cells": what may change of a material.
struct CellParameter {
  /// Where it stands in the entry: "ring_radius", or "shapes/0/pieces/1/radius" of a composed material.
  std::string name;
  base::Dimension dimension;
  double value = 0;         ///< in SI
  double minimum, maximum;  ///< that the format allows; infinite: any
  /// A hundredth of the scale on which geometry changes with it, see interlock::rateOf.
  double step = 0;
};

/// The position of a cell in "interlocking_cells". Throws std::out_of_range if there is none of this name.
std::size_t cellIndex(const Scene& scene, const std::string& name);

/// All real numbers of the entry, in its order.
std::vector<CellParameter> cellParameters(const Scene& scene, std::size_t index);

/// The entry's cell (or its supercell) by the values of these parameters, in SI; not checked, but for what cannot be
/// built at all.
interlock::CellFunction cellFunction(const Scene& scene, std::size_t index,
                                     const std::vector<CellParameter>& parameters);

/// How that cell changes with each of the parameters, at the scene's values; none where it falls into other parts.
std::vector<std::optional<interlock::CellRate>> cellRates(const interlock::CellFunction& build,
                                                          const std::vector<CellParameter>& parameters,
                                                          const Eigen::VectorXd& values);

/// Their values in the scene.
Eigen::VectorXd valuesOf(const std::vector<CellParameter>& parameters);

}  // namespace pliant::scene
