#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cloth/strain_limiter.hpp"
#include "core/mechanics/model.hpp"

namespace pliant::cloth {

/// A motion through given displacements and turns, linear in between, at rest before the first and after the last.
struct Keyframe {
  double time = 0;                                        ///< [s]
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     ///< about the body's centre: axis times angle [rad]
};

/// Nodes that are held: where they rest, or on a path; let go at `release` [s].
struct Pin {
  std::string name;
  std::vector<int> nodes;
  std::vector<Keyframe> path;
  std::optional<double> release;
};

/// Something that the cloth lies on.
struct Body {
  std::string name;
  Eigen::Matrix3Xd points;  ///< at rest [m]
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;  ///< of a capsule; with neither triangles nor edges the points are spheres
  double radius = 0;                      ///< of what is swept along points, edges and triangles [m]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<Keyframe> path;
};

struct Wind {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  double airDensity = 1.2;                             ///< [kg/m³]
  double drag = 1;                                     ///< coefficient along the normal
  double gust = 0;        ///< relative amplitude of a slow sinusoidal change of the velocity
  double gustPeriod = 1;  ///< [s]
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

/// IE and BDF-2 without limits; SAP, SAR (thesis 3.4, Algorithm 1), their BDF-2 variants BAP and BAR, and the
/// second-order reflection of Narain, Zehnder & Thomaszewski 2019.
enum class SteppingScheme {
  implicitEuler,
  bdf2,
  stepAndProject,
  stepAndReflect,
  bdf2AndProject,
  bdf2AndReflect,
  secondOrderReflect
};

struct Energies {
  double kinetic = 0, membrane = 0, bending = 0, gravity = 0;  ///< [J]; gravity is 0 at the rest shape
  double total() const { return kinetic + membrane + bending + gravity; }
};

}  // namespace pliant::cloth
