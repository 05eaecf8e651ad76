#pragma once

#include <memory>

#include "core/scene/macro_result.hpp"
#include "ui/render/frame_view.hpp"
#include "ui/render/macro_field.hpp"

namespace pliant::render {

/// A large piece of interlocking material at rest or in motion, coloured by how near its triangles are to their limits,
/// with the bodies it meets, its clamped and loaded nodes and, where they were computed as well, the origins of its
/// elements; or the elements themselves, as instances of one surface for each shape, the coarser the more there are.
class MacroView final : public FrameView {
 public:
  MacroView();
  ~MacroView() override;

  /// Null: an empty view. What a study that runs hands on has the sheet of what it handed on before: the frame on show
  /// stays; else it is the last.
  void setResult(std::shared_ptr<const scene::MacroResult> result);
  const std::shared_ptr<const scene::MacroResult>& result() const;
  void setField(MacroField field);
  MacroField field() const;
  /// Of a motion.
  void setFrame(int frame) override;
  int frame() const override;
  /// The sheet as it is drawn, of a result that has been set.
  geometry::SurfaceMesh mesh() const;
  /// The elements in their places instead of the sheet, where they have been placed, always (off at first) and not only
  /// while the field is off.
  void setElementsVisible(bool visible);
  bool elementsVisible() const;
  /// Where a native patch was computed as well, its elements to the right of the sheet, in step with it and seen by the
  /// same camera (on at first).
  void setNativeVisible(bool visible);
  bool nativeVisible() const;
  /// Greys the sheet: inputs have changed since.
  void setStale(bool stale);

  /// What a click picks: a triangle, or a node.
  enum class Picks { triangles, nodes };
  void setPicks(Picks picks);
  /// The triangle that is seen at the pixel (x, y) from the top left.
  std::optional<int> triangleAt(double x, double y) const;
  /// Where the middles of all triangles are seen, from the top left; NaN: behind the camera.
  Eigen::Matrix2Xd trianglePixels() const;
  /// Colours triangles by their materials instead of by their field: a number a triangle, into `names`; empty: the
  /// field again.
  void setMaterials(std::vector<int> materials, std::vector<std::string> names);
  /// Rings a triangle; none: no ring.
  void setSelectedTriangle(std::optional<int> triangle);
  std::optional<int> selectedTriangle() const;
  /// The number of a triangle, whatever the radius, or of a node.
  std::optional<int> pickNode(double x, double y, double radius) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
