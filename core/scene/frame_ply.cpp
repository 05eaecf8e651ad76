#include "core/scene/frame_ply.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "core/base/error.hpp"

namespace pliant::scene {

static_assert(std::endian::native == std::endian::little, "frames are written as they lie in memory");

namespace {

template <class T>
void appendValue(std::string& text, const T& value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T takeValue(std::string_view& text) {
  T value;
  std::memcpy(&value, text.data(), sizeof value);
  text.remove_prefix(sizeof value);
  return value;
}

constexpr std::size_t bytesPerFace = 1 + 3 * sizeof(std::int32_t) + 2 * sizeof(double);

}  // namespace

std::string FramePly::header() const {
  return "ply\nformat binary_little_endian 1.0\ncomment " + comment + "\nelement vertex " + std::to_string(nodeCount) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(triangles.size()) +
         "\nproperty list uchar int vertex_indices\nproperty double " + columns[0] + "\nproperty double " + columns[1] +
         "\nend_header\n";
}

std::string FramePly::write(const Eigen::Matrix3Xd& positions,
                            const std::array<const Eigen::VectorXd*, 2>& values) const {
  std::string text = header();
  text.append(
      reinterpret_cast<const char*>(positions.data()), static_cast<std::size_t>(positions.size()) * sizeof(double));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    appendValue(text, std::uint8_t(3));
    for (const int node : triangles[t]) appendValue(text, std::int32_t(node));
    for (const Eigen::VectorXd* value : values) appendValue(text, (*value)[static_cast<Eigen::Index>(t)]);
  }
  return text;
}

void FramePly::read(std::string_view text, Eigen::Matrix3Xd& positions,
                    const std::array<Eigen::VectorXd*, 2>& values) const {
  const std::string expected = header();
  const auto points = static_cast<std::size_t>(nodeCount) * 3 * sizeof(double);
  if (text.substr(0, expected.size()) != expected ||
      text.size() != expected.size() + points + triangles.size() * bytesPerFace)
    throw base::InputError("", "this is no frame of a sheet with " + std::to_string(nodeCount) + " nodes and " +
                                   std::to_string(triangles.size()) + " triangles");
  text.remove_prefix(expected.size());
  positions.resize(3, nodeCount);
  std::memcpy(positions.data(), text.data(), points);
  text.remove_prefix(points);
  for (Eigen::VectorXd* value : values) value->resize(static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    bool same = takeValue<std::uint8_t>(text) == 3;
    for (const int node : triangles[t]) same = takeValue<std::int32_t>(text) == node && same;
    if (!same) throw base::InputError("", "triangle " + std::to_string(t) + " of this frame is not that of the scene");
    for (Eigen::VectorXd* value : values) (*value)[static_cast<Eigen::Index>(t)] = takeValue<double>(text);
  }
  if (!positions.allFinite() || !values[0]->allFinite() || !values[1]->allFinite())
    throw base::InputError("", "this frame holds a number that is not finite");
}

std::string frameFileName(std::size_t index) {
  char name[48];
  std::snprintf(name, sizeof name, "frames/frame_%05zu.ply", index);
  return name;
}

}  // namespace pliant::scene
