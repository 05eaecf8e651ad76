#include <bit>
#include <cstdint>
#include <cstring>

#include "core/base/error.hpp"
#include "core/scene/cloth_result.hpp"

namespace pliant::scene {

static_assert(std::endian::native == std::endian::little, "frames are written as they lie in memory");

namespace {

std::string plyHeader(const cloth::LimitedSheet& sheet) {
  return "ply\nformat binary_little_endian 1.0\ncomment positions in metres, limit forces in J s^2\nelement vertex " +
         std::to_string(sheet.nodeCount) + "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(sheet.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nproperty double stretch_ratio\nproperty double limit_force\n"
         "end_header\n";
}

template <class T>
void append(std::string& text, const T& value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T take(std::string_view& text) {
  T value;
  std::memcpy(&value, text.data(), sizeof value);
  text.remove_prefix(sizeof value);
  return value;
}

constexpr std::size_t bytesPerFace = 1 + 3 * sizeof(std::int32_t) + 2 * sizeof(double);

}  // namespace

std::string frameToPly(const ClothFrame& frame, const cloth::LimitedSheet& sheet) {
  std::string text = plyHeader(sheet);
  text.append(reinterpret_cast<const char*>(frame.positions.data()),
              static_cast<std::size_t>(frame.positions.size()) * sizeof(double));
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    append(text, std::uint8_t(3));
    for (const int node : sheet.triangles[t].nodes) append(text, std::int32_t(node));
    append(text, frame.stretchRatios[static_cast<Eigen::Index>(t)]);
    append(text, frame.limitForces[static_cast<Eigen::Index>(t)]);
  }
  return text;
}

ClothFrame frameFromPly(std::string_view text, const cloth::LimitedSheet& sheet) {
  const std::string header = plyHeader(sheet);
  const auto points = static_cast<std::size_t>(sheet.nodeCount) * 3 * sizeof(double);
  if (text.substr(0, header.size()) != header ||
      text.size() != header.size() + points + sheet.triangles.size() * bytesPerFace)
    throw base::InputError("", "this is no frame of a cloth with " + std::to_string(sheet.nodeCount) + " nodes and " +
                                   std::to_string(sheet.triangles.size()) + " triangles");
  text.remove_prefix(header.size());
  ClothFrame frame;
  frame.positions.resize(3, sheet.nodeCount);
  std::memcpy(frame.positions.data(), text.data(), points);
  text.remove_prefix(points);
  frame.stretchRatios.resize(static_cast<Eigen::Index>(sheet.triangles.size()));
  frame.limitForces.resizeLike(frame.stretchRatios);
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    bool same = take<std::uint8_t>(text) == 3;
    for (const int node : sheet.triangles[t].nodes) same = take<std::int32_t>(text) == node && same;
    if (!same) throw base::InputError("", "triangle " + std::to_string(t) + " of this frame is not that of the scene");
    frame.stretchRatios[static_cast<Eigen::Index>(t)] = take<double>(text);
    frame.limitForces[static_cast<Eigen::Index>(t)] = take<double>(text);
  }
  if (!frame.positions.allFinite() || !frame.stretchRatios.allFinite() || !frame.limitForces.allFinite())
    throw base::InputError("", "this frame holds a number that is not finite");
  return frame;
}

}  // namespace pliant::scene
