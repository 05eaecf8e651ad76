#pragma once

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <functional>
#include <string>

#include "ui/render/camera_control.hpp"
#include "ui/render/gizmo.hpp"
#include "ui/render/legend.hpp"
#include "ui/render/thread_safe_text.hpp"
#include "ui/render/view.hpp"

namespace pliant::render {

/// What stands around the figure of every view: a renderer with its light, the camera, the gizmo, the scalar bar and
/// two labels. The view's own parts follow it through hooks.
class Stage {
 public:
  Stage();
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  vtkRenderer* renderer() { return renderer_; }
  CameraControl& camera() { return camera_; }
  const CameraControl& camera() const { return camera_; }
  Legend& legend() { return legend_; }
  const Palette& colors() const;
  Theme theme() const { return theme_; }
  vtkRenderWindow* window() const { return window_; }
  double pixelRatio() const { return ratio_; }
  bool fieldVisible() const { return fieldVisible_; }

  void attach(vtkRenderWindow* window);
  void setCaption(const std::string& text);
  const std::string& caption() const { return captionText_; }
  /// Below the caption; empty: none.
  void setNotice(const std::string& text, const Color& color);
  void setTheme(Theme theme);
  void setPixelRatio(double ratio);
  void setFineQuality(bool fine);
  void setFieldVisible(bool visible);
  void setFrameless(bool frameless);
  /// For figures with axes of their own.
  void setGizmoVisible(bool visible);
  /// Shows the scalar bar and keeps room for it.
  void setLegendVisible(bool visible);

  std::function<void()> onLayOut;      ///< rendering begins: what is measured in pixels is put in its place
  std::function<void()> onTheme;       ///< other colours
  std::function<void()> onPixelRatio;  ///< another size of pixels
  std::function<void()> onField;       ///< the field is shown or hidden
  std::function<void()> onAttach;      ///< it is in another window, or in none

 private:
  void layOut();

  ThreadSafeText threadSafeText_;  // before any text
  vtkNew<vtkRenderer> renderer_;
  CameraControl camera_{renderer_};
  Gizmo gizmo_;
  Legend legend_;
  vtkNew<vtkTextActor> caption_;
  vtkNew<vtkTextActor> notice_;
  vtkRenderWindow* window_ = nullptr;
  unsigned long observer_ = 0;
  Theme theme_ = Theme::light;
  double ratio_ = 1;
  bool fine_ = true;
  bool fieldVisible_ = true;
  bool legendVisible_ = false;
  bool frameless_ = false;
  bool gizmoVisible_ = true;
  std::string captionText_;
};

}  // namespace pliant::render
