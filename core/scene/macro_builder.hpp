#pragma once

#include "core/interlock/macro_motion.hpp"
#include "core/interlock/unit_cell.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// What studies of large pieces make of their keys.
class MacroBuilder {
 public:
  /// `place` is where the study stands, for errors.
  MacroBuilder(const Scene& scene, const Json& options, std::string place);

  /// The outline, meshed, with the materials of all its regions; limits that no file gives are computed. Throws
  /// base::InputError. Where the context is cancelled materials may be without limits. Progress goes from 0 to `until`.
  interlock::MacroSheet sheet(const interlock::UnitCell& cell, double until, base::ExecutionContext& context) const;
  interlock::MacroContact contact() const;
  /// Gravity, forces and clamps; `loaded` gets the nodes of the forces.
  interlock::MacroLoads loads(const interlock::MacroSheet& sheet, std::vector<int>* loaded = nullptr) const;
  std::vector<interlock::MacroGrip> grips(const interlock::MacroSheet& sheet) const;
  /// The sheet at rest where the scene puts it.
  interlock::Vector start(const interlock::MacroSheet& sheet) const;
  /// Of a material without "thickness" the height of its elements [m].
  static double heightOf(const interlock::UnitCell& cell);

 private:
  geometry::SurfaceMesh outline() const;
  interlock::MacroMaterial material(const Json& keys, const interlock::UnitCell& cell, const std::string& place,
                                    base::ExecutionContext& context) const;
  std::shared_ptr<const mechanics::AdmissibleStrainSet> readSet(const Json& keys, const char* key,
                                                                const std::string& place) const;
  const Scene& scene_;
  const Json& options_;
  std::string place_;
};

/// Of all places (3 x n) the one nearest to `point` in the plane.
int nearestOf(const Eigen::Matrix3Xd& places, const Eigen::Vector2d& point);
/// All within the "radius" of an entry's "point", or else the nearest.
std::vector<int> nodesWithin(const Eigen::Matrix3Xd& places, const Json& entry);
/// Triangles of a region whose keys have all their values. Throws base::InputError (location empty) for one that has
/// none, or names some that are not there.
std::vector<int> regionTriangles(const Json& region, const geometry::SurfaceMesh& mesh);
/// From a list of numbers.
Eigen::Vector3d spaceOf(const Json& list);
Eigen::Vector2d planeOf(const Json& list);

}  // namespace pliant::scene
