#pragma once

#include <vtkActor2D.h>
#include <vtkPolyData.h>

#include <memory>
#include <vector>

#include "core/interlock/cell_contact.hpp"
#include "ui/render/body_glyphs.hpp"
#include "ui/render/stage.hpp"

namespace pliant::render {

/// The right half of a window: a patch of elements, seen by the camera of what the left half shows.
class NativeHalf {
 public:
  /// Divides the window of `left`, which outlives this.
  NativeHalf(Stage& left, std::shared_ptr<const interlock::UnitCell> patch);
  /// Gives the whole window back.
  ~NativeHalf();
  NativeHalf(const NativeHalf&) = delete;
  NativeHalf& operator=(const NativeHalf&) = delete;

  const std::shared_ptr<const interlock::UnitCell>& patch() const { return patch_; }
  void attach(vtkRenderWindow* window) { stage_.attach(window); }
  void pose(const interlock::CellState& state);
  void setCaption(const std::string& text) { stage_.setCaption(text); }
  void setTheme(Theme theme, bool stale);
  void setPixelRatio(double ratio) { stage_.setPixelRatio(ratio); }

 private:
  /// Elements of one shape.
  struct Kind {
    BodyGlyphs bodies;
    std::vector<int> elements;
  };

  Stage& left_;
  Stage stage_;
  std::shared_ptr<const interlock::UnitCell> patch_;
  std::vector<std::unique_ptr<Kind>> kinds_;
  std::vector<int> tintOf_;
  vtkNew<vtkPolyData> line_;
  vtkNew<vtkActor2D> divider_;
};

}  // namespace pliant::render
