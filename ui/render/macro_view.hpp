#pragma once

#include <memory>

#include "core/scene/macro_result.hpp"
#include "ui/render/image.hpp"
#include "ui/render/offscreen.hpp"
#include "ui/render/view.hpp"

namespace pliant::render {

/// What colours a sheet of interlocking material: how near it is to its limits, 1 being at one.
enum class MacroField { nearest, stretch, bending };

/// A large piece of interlocking material at rest or in motion, coloured by how near its triangles are to their limits,
/// with the bodies it meets, its clamped and loaded nodes and, where they were computed as well, the origins of its
/// elements; or the elements themselves, as instances of one surface for each shape, the coarser the more there are.
class MacroView final : public View {
 public:
  MacroView();
  ~MacroView() override;

  /// Null: an empty view.
  void setResult(std::shared_ptr<const scene::MacroResult> result);
  const std::shared_ptr<const scene::MacroResult>& result() const;
  void setField(MacroField field);
  /// Of a motion the frame with this number, if there is one; at first the last.
  void setFrame(int frame);
  /// The elements in their places instead of the sheet, where they have been placed, always (off at first) and not only
  /// while the field is off.
  void setElementsVisible(bool visible);
  bool elementsVisible() const;
  /// Greys the sheet: inputs have changed since.
  void setStale(bool stale);

  /// What a click picks: a triangle, or a node.
  enum class Picks { triangles, nodes };
  void setPicks(Picks picks);
  /// Rings a triangle; none: no ring.
  void setSelectedTriangle(std::optional<int> triangle);
  /// The number of a triangle, whatever the radius, or of a node.
  std::optional<int> pickNode(double x, double y, double radius) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The numbers that belong to it, in lines.
std::string macroCaption(const scene::MacroResult& result);

/// Draws it without a display, as renderToImage() does; of a motion the frame nearest to `time` [s], of placed elements
/// these if asked for.
Image drawMacro(const std::shared_ptr<const scene::MacroResult>& result, const PictureOptions& options,
                std::optional<double> time = std::nullopt, bool elements = false);

}  // namespace pliant::render
