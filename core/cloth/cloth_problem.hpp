#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cloth/strain_limiter.hpp"
#include "core/mechanics/contact_body.hpp"
#include "core/mechanics/model.hpp"

namespace pliant::cloth {

using mechanics::Body;
using mechanics::Keyframe;

/// Nodes that are held: where they rest, or on a path; let go at `release` [s].
struct Pin {
  std::string name;
  std::vector<int> nodes;
  std::vector<Keyframe> path;  ///< turns are about the mean of the nodes' rest positions
  std::optional<double> release;
};

/// Air that streams past. A triangle of area A with unit normal n, whose mean velocity is v, feels
/// ½ ρ c A |u| u n with u = (w (1 + gust sin(2π t / gustPeriod)) - v)·n.
struct Wind {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< w [m/s]
  double airDensity = 1.2;                             ///< ρ [kg/m³]
  double drag = 1;                                     ///< c, coefficient along the normal
  double gust = 0;                                     ///< relative amplitude of a slow change of the velocity
  double gustPeriod = 1;                               ///< [s]

  /// The air's velocity at `time` [m/s].
  Eigen::Vector3d velocityAt(double time) const;
};

/// What does not change while it moves.
struct ClothProblem {
  std::shared_ptr<const mechanics::Model> model;  ///< 3-dimensional, without scalar coordinates, drives or rods
  LimitedSheet sheet;
  std::vector<Pin> pins;
  std::vector<Body> bodies;
  std::optional<Wind> wind;
  double contactDistance = 1e-3;  ///< gap below which contact begins to push [m]
  bool selfContact = false;
};

struct Energies {
  double kinetic = 0, membrane = 0, bending = 0, gravity = 0;  ///< [J]; gravity is 0 at the rest shape
  double other = 0;                                            ///< of springs, solids and links [J]
  double contact = 0;                                          ///< of the contact barrier [J]
  double total() const { return kinetic + membrane + bending + gravity + other + contact; }
};

/// Throws base::InputError (location empty) if the model has another dimension than 3, scalar coordinates, drives or
/// forces that swing, if masses couple nodes or are not above 0 where a node can move, if coordinates of a node are
/// locked but not all, or if the sheet's or pins' nodes are not the model's.
void checkClothProblem(const ClothProblem& problem);

/// Where the nodes of a pin are at `time` (3 x nodes) [m].
Eigen::Matrix3Xd pinnedPositions(const ClothProblem& problem, const Pin& pin, double time);

/// Nodes whose three coordinates the model locks: pins that never move.
std::vector<char> lockedNodes(const mechanics::Model& model);

/// Which nodes are held at `time`: those the model locks, and those of pins that are not released before it.
std::vector<char> heldNodes(const ClothProblem& problem, double time);

/// Moves the nodes of pins that hold at `time` to where they are then.
void placePins(const ClothProblem& problem, double time, Eigen::Matrix3Xd& positions);

bool hasLimits(const LimitedSheet& sheet);

/// Kinetic, elastic and gravity energy (constant forces count as gravity) at positions and velocities (3 x nodes).
Energies energiesAt(const ClothProblem& problem, const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& velocities);

/// Mass of each node [kg], from the model.
Eigen::VectorXd lumpedMasses(const mechanics::Model& model);

}  // namespace pliant::cloth
