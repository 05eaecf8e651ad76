#pragma once

#include "core/mechanics/model.hpp"

namespace pliant::jobs {

/// Whether both models have the same nodes at the same places of rest, so that a node has one number in both.
bool sameNodes(const mechanics::Model& a, const mechanics::Model& b);

/// The node of `to` that a designer takes for `node` of `from`: the same node if both have the same nodes, else that of
/// the probe with the same name; -1 if there is none.
int correspondingNode(const mechanics::Model& from, int node, const mechanics::Model& to);

}  // namespace pliant::jobs
