#pragma once

#include <vtkRenderer.h>

#include <memory>
#include <vector>

#include "core/scene/macro_result.hpp"
#include "ui/render/body_glyphs.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

/// The placed elements of a sheet: instances of one surface for each shape. How finely it is cut depends on how many
/// there are, so that a picture has so many triangles at most as even software draws at once.
class ElementFigure {
 public:
  void addTo(vtkRenderer* renderer) { renderer_ = renderer; }
  /// Null: none.
  void show(const scene::MacroResult* result);
  void setColors(const Palette& colors);
  void setVisible(bool visible);
  /// Of all instances.
  long triangleCount() const { return triangleCount_; }

 private:
  struct Shape {
    BodyGlyphs glyphs;
    std::vector<int> tints;  ///< of its elements
  };

  vtkRenderer* renderer_ = nullptr;
  std::vector<std::unique_ptr<Shape>> shapes_;
  const scene::MacroResult* shown_ = nullptr;
  Palette colors_{};
  long triangleCount_ = 0;
};

}  // namespace pliant::render
