#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/mechanics/model.hpp"
#include "core/mechanics/shell.hpp"
#include "core/scene/placed_geometry.hpp"

namespace pliant::scene {

/// Three scalar coordinates by which a rod's sections turn with a node (mechanics::RodNetwork).
struct NodeFrame {
  int node;
  int firstCoordinate;
  double length;  ///< frameLength [m]
};

/// What the builder of one entry of "elements" reads and adds to.
struct ElementContext {
  const Json& entry;           ///< normalised
  const std::string& pointer;  ///< of the entry
  const Json* material;        ///< the entry's material, normalised; null for elements without one
  const PlacedGeometry& geometry;
  mechanics::MassMatrix massMatrix;
  const std::set<int>& heldNodes;              ///< locked wholly, or driven: these clamp the rods that meet there
  mechanics::Model& model;                     ///< energies and scalar coordinates are added to it
  mechanics::DisplayPart& part;                ///< of the geometry
  std::vector<Eigen::Triplet<double>>& mass;   ///< on all coordinates [kg]
  std::vector<NodeFrame>& frames;              ///< of rods
  std::vector<mechanics::ShellPanel>& panels;  ///< of shells that bend
  const std::filesystem::path& directory;      ///< of the scene
};

using ElementBuilder = void (*)(const ElementContext&);

/// By "type". Builders throw base::InputError.
const std::map<std::string, ElementBuilder>& elementBuilders();

}  // namespace pliant::scene
