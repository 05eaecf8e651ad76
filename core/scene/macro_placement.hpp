#pragma once

#include "core/scene/macro_result.hpp"

namespace pliant::scene {

/// What "elements" of a sheet of this cell are cut from: the cell itself, or with regions all their materials on the
/// lattice that they share (interlock::sharedLattice). `place` is where the study stands, for errors. Throws
/// base::InputError for regions whose materials are turned or share no lattice.
std::shared_ptr<const interlock::UnitCell> placedCell(const Scene& scene, const Json& options, const std::string& place,
                                                      const std::shared_ptr<const interlock::UnitCell>& cell);

/// How far the sheet moves from one place to the next of the way that its elements follow [m].
double placementSpacing(const interlock::UnitCell& cell);

/// Puts the elements of result.cell, which is a placedCell, on the sheet, following the way it took: positions of its
/// nodes, the first flat. What the study then ended with, and why. Throws base::InputError if elements of different
/// regions do not hold each other at rest.
struct PlacementOutcome {
  base::TerminationType termination;
  std::string message;
};
PlacementOutcome placeElements(const std::vector<interlock::Vector>& way, const Json& options, const std::string& place,
                               MacroResult& result, base::ExecutionContext& context);

}  // namespace pliant::scene
