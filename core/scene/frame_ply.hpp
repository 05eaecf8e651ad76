#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace pliant::scene {

/// A moving sheet of triangles at one instant, as binary PLY: doubles x, y, z of the nodes, and two doubles a triangle.
struct FramePly {
  std::string comment;                 ///< one line
  std::array<std::string, 2> columns;  ///< names of the triangles' numbers
  std::vector<std::array<int, 3>> triangles;
  long nodeCount = 0;

  std::string write(const Eigen::Matrix3Xd& positions, const std::array<const Eigen::VectorXd*, 2>& values) const;
  /// Throws base::InputError (location empty) if `text` is anything but what `write` makes with the same triangles.
  void read(std::string_view text, Eigen::Matrix3Xd& positions, const std::array<Eigen::VectorXd*, 2>& values) const;

 private:
  std::string header() const;
};

/// "frames/frame_00007.ply"
std::string frameFileName(std::size_t index);

}  // namespace pliant::scene
