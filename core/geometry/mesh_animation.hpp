#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace pliant::geometry {

/// A mesh whose points move: one 3 x n matrix a frame [m], with times ascending [s].
struct MeshAnimation {
  std::vector<std::array<int, 3>> triangles;
  std::vector<Eigen::Matrix3Xd> frames;
  std::vector<double> times;
};

/// Writes an animated .glb (glTF 2.0, binary): the first frame is the mesh, each further one a morph target (position
/// differences as floats), and at each time exactly one of them is fully on; in between they are mixed linearly.
/// Throws base::InputError (location empty) if there are no frames or triangles, their sizes differ, times do not
/// ascend, a number is not finite, or as base::writeFile does if the file cannot be written.
void writeAnimation(const MeshAnimation& animation, const std::filesystem::path& file);

}  // namespace pliant::geometry
