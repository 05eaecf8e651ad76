#include "ui/render/boundary_picture.hpp"

#include <vtkRenderWindow.h>

#include "ui/render/offscreen_target.hpp"

namespace pliant::render {
namespace {

Image drawView(View& view, OffscreenTarget& target, const PictureOptions& options) {
  view.setTheme(options.theme);
  view.setCaption(options.caption);
  view.setAxisView(options.view);
  Image image;
  target.render(image);
  return image;
}

}  // namespace

Image drawBoundary(const BoundaryScenery& scenery, const PictureOptions& options) {
  OffscreenTarget target;
  target.setSize(options.width, options.height);
  BoundaryView view;
  view.attach(target.window());
  view.setStyle(scenery.style);
  view.setSurface(scenery.surface);
  view.setCompared(scenery.compared);
  return drawView(view, target, options);
}

Image drawPatch(const std::shared_ptr<const PatchConfiguration>& configuration, const PictureOptions& options) {
  OffscreenTarget target;
  target.setSize(options.width, options.height);
  PatchView view;
  view.attach(target.window());
  view.setConfiguration(configuration);
  return drawView(view, target, options);
}

Image drawConfiguration(const std::shared_ptr<const CellConfiguration>& configuration, const PictureOptions& options) {
  OffscreenTarget target;
  target.setSize(options.width, options.height);
  LimitView view;
  view.attach(target.window());
  view.setConfiguration(configuration);
  return drawView(view, target, options);
}

}  // namespace pliant::render
