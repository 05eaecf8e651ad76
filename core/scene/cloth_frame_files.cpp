#include "core/scene/cloth_result.hpp"
#include "core/scene/frame_ply.hpp"

namespace pliant::scene {

namespace {

FramePly clothFrames(const cloth::LimitedSheet& sheet) {
  FramePly frames{"positions in metres, limit forces in J s^2", {"stretch_ratio", "limit_force"}, {}, sheet.nodeCount};
  for (const cloth::SheetTriangle& triangle : sheet.triangles) frames.triangles.push_back(triangle.nodes);
  return frames;
}

}  // namespace

std::string frameToPly(const ClothFrame& frame, const cloth::LimitedSheet& sheet) {
  return clothFrames(sheet).write(frame.positions, {&frame.stretchRatios, &frame.limitForces});
}

ClothFrame frameFromPly(std::string_view text, const cloth::LimitedSheet& sheet) {
  ClothFrame frame;
  clothFrames(sheet).read(text, frame.positions, {&frame.stretchRatios, &frame.limitForces});
  return frame;
}

}  // namespace pliant::scene
