#include "core/geometry/mesh_animation.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"
#include "core/base/pending_file.hpp"

namespace pliant::geometry {

namespace {

using Json = nlohmann::ordered_json;

constexpr int floatType = 5126, unsignedType = 5125;  // of glTF's accessors
constexpr int arrayTarget = 34962, elementTarget = 34963;

void checkAnimation(const MeshAnimation& animation) {
  const auto fail = [](const char* problem) { throw base::InputError("", problem); };
  if (animation.frames.empty() || animation.triangles.empty()) fail("There are no frames to write.");
  if (animation.frames.size() != animation.times.size()) fail("An animation needs a time for each of its frames.");
  const Eigen::Index points = animation.frames.front().cols();
  for (std::size_t i = 0; i < animation.frames.size(); ++i) {
    if (animation.frames[i].cols() != points) fail("All frames of an animation must have as many points.");
    if (!animation.frames[i].allFinite() || !std::isfinite(animation.times[i])) fail("A frame is not finite.");
    if (i > 0 && animation.times[i] <= animation.times[i - 1]) fail("The times of an animation must ascend.");
  }
  for (const auto& triangle : animation.triangles)
    for (const int node : triangle)
      if (node < 0 || node >= points) fail("A triangle of an animation names a point that does not exist.");
}

/// The binary part of the file and the accessors into it.
class GltfBuffer {
 public:
  /// Columns as three floats each, with their bounds; returns the accessor's index.
  int addPoints(const Eigen::Matrix3Xf& points) {
    const Eigen::Vector3f low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
    const int accessor = add(points.data(), static_cast<std::size_t>(points.size()) * sizeof(float), floatType,
                             points.cols(), "VEC3", arrayTarget);
    accessors_[static_cast<std::size_t>(accessor)]["min"] = {low[0], low[1], low[2]};
    accessors_[static_cast<std::size_t>(accessor)]["max"] = {high[0], high[1], high[2]};
    return accessor;
  }

  int addIndices(const std::vector<std::array<int, 3>>& triangles) {
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
    return add(indices.data(), indices.size() * sizeof(std::uint32_t), unsignedType,
               static_cast<Eigen::Index>(indices.size()), "SCALAR", elementTarget);
  }

  int addNumbers(const std::vector<float>& numbers, bool withBounds) {
    const int accessor = add(numbers.data(), numbers.size() * sizeof(float), floatType,
                             static_cast<Eigen::Index>(numbers.size()), "SCALAR", 0);
    if (withBounds) {
      accessors_[static_cast<std::size_t>(accessor)]["min"][0] = numbers.front();
      accessors_[static_cast<std::size_t>(accessor)]["max"][0] = numbers.back();
    }
    return accessor;
  }

  const Json& accessors() const { return accessors_; }
  const Json& views() const { return views_; }
  const std::string& bytes() const { return bytes_; }

 private:
  int add(const void* data, std::size_t size, int componentType, Eigen::Index count, const char* type, int target) {
    Json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    accessors_.push_back(
        {{"bufferView", views_.size()}, {"componentType", componentType}, {"count", count}, {"type", type}});
    views_.push_back(std::move(view));
    bytes_.append(static_cast<const char*>(data), size);  // all parts are whole words
    return static_cast<int>(accessors_.size()) - 1;
  }

  Json accessors_ = Json::array(), views_ = Json::array();
  std::string bytes_;
};

void appendWord(std::string& text, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  char bytes[4];
  std::memcpy(bytes, &word, 4);
  text.append(bytes, 4);
}

}  // namespace

void writeAnimation(const MeshAnimation& animation, const std::filesystem::path& file) {
  checkAnimation(animation);
  GltfBuffer buffer;
  const int indices = buffer.addIndices(animation.triangles);
  const int base = buffer.addPoints(animation.frames.front().cast<float>());
  Json targets = Json::array();
  for (std::size_t i = 1; i < animation.frames.size(); ++i)
    targets.push_back({{"POSITION", buffer.addPoints((animation.frames[i] - animation.frames.front()).cast<float>())}});
  Json primitive{{"attributes", {{"POSITION", base}}}, {"indices", indices}, {"material", 0}};
  Json mesh{{"primitives", Json::array()}};
  Json document;
  document["asset"] = {{"version", "2.0"}, {"generator", "Pliant"}};
  document["scene"] = 0;
  document["scenes"][0]["nodes"][0] = 0;
  document["nodes"][0]["mesh"] = 0;
  document["nodes"][0]["rotation"] = {-0.70710678, 0, 0, 0.70710678};  // glTF's y-axis points up, ours is z
  document["materials"][0]["doubleSided"] = true;
  if (!targets.empty()) {
    const std::size_t count = targets.size();
    std::vector<float> weights((count + 1) * count, 0);
    for (std::size_t i = 1; i <= count; ++i) weights[i * count + i - 1] = 1;
    const int times = buffer.addNumbers({animation.times.begin(), animation.times.end()}, true);
    const int output = buffer.addNumbers(weights, false);
    primitive["targets"] = std::move(targets);
    mesh["weights"] = std::vector<int>(count, 0);
    Json& animated = document["animations"][0];
    animated["samplers"][0] = {{"input", times}, {"interpolation", "LINEAR"}, {"output", output}};
    animated["channels"][0]["sampler"] = 0;
    animated["channels"][0]["target"] = {{"node", 0}, {"path", "weights"}};
  }
  mesh["primitives"].push_back(std::move(primitive));
  document["meshes"][0] = mesh;
  document["accessors"] = buffer.accessors();
  document["bufferViews"] = buffer.views();
  document["buffers"][0]["byteLength"] = buffer.bytes().size();
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string head;
  appendWord(head, 0x46546C67);  // "glTF"
  appendWord(head, 2);
  appendWord(head, 12 + 8 + text.size() + 8 + buffer.bytes().size());
  appendWord(head, text.size());
  appendWord(head, 0x4E4F534A);  // "JSON"
  std::string middle;
  appendWord(middle, buffer.bytes().size());
  appendWord(middle, 0x004E4942);  // "BIN"
  base::writeFile(file, head + text + middle + buffer.bytes());
}

}  // namespace pliant::geometry
