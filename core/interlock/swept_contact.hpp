#pragma once

#include <limits>

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// A fraction t in (0, 1] of a motion such that no two places of different elements, or images, meet on the way; if t
/// < 1 a pair of simplices has lost 0.8 of its gap and is nearer than `near` [m], or arcs would come too near. The
/// motion is that of `moved` with the velocity `motion` [m, rad, 1] and steps from 0 to 1: translations and the change
/// of the lattice are straight, rotations go on about their axes. On top of it each element may move by `beyond` times
/// the step at most [m, one entry an element]. Gaps must be above 0 at the start; images that are farther than `reach`
/// [m] must come no nearer than their gap.
///
/// A part of an element is bounded by the ball of its node in the element's tree, and a point at the arm y moves no
/// farther than |dx| + |dw x y|. Pairs whose balls cannot meet are left out; so are those whose path is below twice
/// their radii, see CellSolver. For other pairs of simplices it is additive advancement (Li, Kaufman & Jiang 2021, as
/// in geometry::safeFraction): along the direction n between the closest points, min n·x_A - max n·x_B over the corners
/// bounds the distance, and for rotating corners it shrinks by τ v + τ²/2 |dw| |dw x y| at most in the time τ. With
/// arcs it is steps below twice the radii, after each of which the gap must be above 0.
double safeFraction(const CellContact& contact, const CellState& state, const Eigen::VectorXd& motion,
                    const Eigen::VectorXd& beyond, double reach, double near = std::numeric_limits<double>::infinity());

/// How far any place of an element moves at most on the shortest way from one state to another, without the lattice
/// [m].
double farthestMove(const CellContact& contact, const CellState& from, const CellState& to);

}  // namespace pliant::interlock
