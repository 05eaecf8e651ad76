#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace pliant::scene {

/// The polygon in a CSV file with the columns "x [mm]" and "y [mm]" (or another length), corners in order, lengths in
/// metres; with a third column "loop" one polygon for each of its numbers, the outer one first. Of an OBJ file the
/// polygons that its lines "l" go through, or all its points in order, in metres, without their z. Throws
/// base::InputError with the file as location.
std::vector<Eigen::Matrix2Xd> readOutline(const std::filesystem::path& file);

}  // namespace pliant::scene
