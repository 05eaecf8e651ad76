#pragma once

#include <memory>
#include <vector>

#include "core/scene/cloth_result.hpp"
#include "ui/render/frame_view.hpp"

namespace pliant::render {

/// What colours a sheet.
enum class ClothField {
  stretchRatio,  ///< the largest stretch over its limit: 1 is at the limit
  limitForce     ///< what the limits press with
};

/// A node that is held by hand, and where the hand is [m].
struct Hand {
  int node = -1;
  Eigen::Vector3d place;
};

/// A cloth with its bodies and pins, at one of its frames. Frames may be added while it is seen. The sheet is shaded
/// smoothly from both sides and coloured by how near it is to its limits.
class ClothView final : public FrameView {
 public:
  ClothView();
  ~ClothView() override;

  /// Shows a cloth at rest, without frames. Null: an empty view.
  void setProblem(std::shared_ptr<const cloth::ClothProblem> problem);
  /// All frames in the order of time; those that were there stay the same while a study runs.
  void setFrames(std::vector<std::shared_ptr<const scene::ClothFrame>> frames);
  void setFrame(int frame) override;
  /// Looks at the frame on show alone, not at all that the cloth reaches; at the broad side of what hangs as a sheet.
  void faceFrame();
  /// -1: at rest.
  int frame() const override;
  /// Greys the sheet: inputs have changed since.
  void setStale(bool stale);
  void setField(ClothField field);
  ClothField field() const;
  /// Short lines along the first material direction of some triangles (off at first).
  void setDirectionsVisible(bool visible);
  bool directionsVisible() const;
  void setSelectedNode(std::optional<int> node);
  std::optional<int> selectedNode() const;
  /// Marks nodes that hands hold, each with a line to its hand where that is elsewhere.
  void setHands(std::vector<Hand> hands);
  /// Where a node is drawn [m].
  Eigen::Vector3d nodePosition(int node) const;
  /// What is seen at the pixel (x, y) (from the top left) in the plane through `point` that faces the camera.
  std::optional<Eigen::Vector3d> pointBeside(const Eigen::Vector3d& point, double x, double y) const;

  std::optional<int> pickNode(double x, double y, double radius) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
