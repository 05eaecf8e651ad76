#pragma once

#include <Eigen/Core>
#include <filesystem>

namespace pliant::scene {

/// A position for each of `nodeCount` nodes (3 x n) [m], from
///  - a PLY file in ASCII or little-endian binary whose vertices have x, y and z, or
///  - a CSV file with a header and three columns, or four of which the first is the node's number in order.
/// Throws base::InputError with the file as location and one sentence, for a table with the line in it.
Eigen::Matrix3Xd readCandidate(const std::filesystem::path& file, int nodeCount);

}  // namespace pliant::scene
