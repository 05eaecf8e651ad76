#pragma once

#include "core/mechanics/model.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// The places that a target path of an objective of the type "path" (`entry`, normalised) passes at even steps of time,
/// the first after the last: dimension x n [m]. Throws base::InputError for a file that cannot be read.
mechanics::Matrix targetPlaces(const Scene& scene, const Json& entry, int dimension);

/// The points that its spline passes: dimension x n [m]; none if it is given otherwise.
mechanics::Matrix targetControlPoints(const Json& entry, int dimension);

/// The places in a table with the columns "x [m]", "y [m]", ...: dimension x n [m]. Throws base::InputError if it
/// cannot be read or has fewer than 3 rows.
mechanics::Matrix placesOfTable(const std::filesystem::path& file, int dimension);

/// A target path that a design study of a scene has.
struct TargetPath {
  std::string study;
  std::string pointer;  ///< of the path's entry
  std::string probe;
  int node = 0;
  bool matchPlace = false;   ///< whether its place counts, not its shape alone
  int harmonics = 0;         ///< of the study
  mechanics::Matrix places;  ///< at even steps of time: dimension x n [m]
  mechanics::Matrix controlPoints;
};

/// All of them. What cannot be read is left out: its study says why.
std::vector<TargetPath> targetPaths(const Scene& scene, const mechanics::Model& model);

}  // namespace pliant::scene
