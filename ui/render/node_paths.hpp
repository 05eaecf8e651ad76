#pragma once

#include <vector>

#include "ui/render/points.hpp"
#include "ui/render/predicted_motion.hpp"

namespace pliant::render {

struct FigureLayout;

/// The closed paths of some nodes of a motion whose `trajectories` are known (samples x coordinates), one column a
/// place: its samples' trigonometric interpolant, so that paths are smooth however few samples a solver takes.
std::vector<Points> nodePaths(const harmonic::HarmonicBalanceProblem& problem, const mechanics::Matrix& trajectories,
                              const std::vector<int>& nodes);

/// All coordinates at instants that tell how far a motion reaches and how much it stretches: a solver may take so few
/// samples that more happens between them. One row an instant.
mechanics::Matrix instantsOf(const PredictedMotion& motion);

/// The places of everything that moves, at all instants.
Points reachOf(const FigureLayout& layout, const mechanics::Matrix& instants);

/// Both, one after the other.
Points joined(const Points& a, const Points& b);

}  // namespace pliant::render
