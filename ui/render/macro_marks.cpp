#include "ui/render/macro_marks.hpp"

namespace pliant::render {

namespace {

void put(const CameraControl& camera, const Points& places, DotOverlay& dots) {
  Eigen::Matrix2Xd pixels(2, places.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < places.cols(); ++i)
    if (const auto pixel = camera.pixelOf(places.col(i))) pixels.col(count++) = *pixel;
  dots.setPlaces(pixels.leftCols(count));
}

}  // namespace

void MacroMarks::addTo(vtkRenderer* renderer) {
  for (DotOverlay* dots : {&clamps_, &loads_, &origins_}) dots->addTo(renderer);
  ring_.addTo(renderer);
}

void MacroMarks::setPixelRatio(double ratio) {
  for (DotOverlay* dots : {&clamps_, &loads_, &origins_}) dots->setPixelRatio(ratio);
  ring_.setPixelRatio(ratio);
}

void MacroMarks::setVisible(bool visible) {
  for (DotOverlay* dots : {&clamps_, &loads_, &origins_}) dots->setVisible(visible);
  if (!visible) ring_.setPlace(std::nullopt);
}

void MacroMarks::setColors(const Palette& colors) {
  clamps_.setColors(colors.link, colors.background);
  loads_.setColors(colors.driven, colors.background);
  origins_.setColors(colors.prediction, colors.background);
  ring_.setColors(colors.text, colors.background);
}

void MacroMarks::place(const CameraControl& camera, const Points& clamped, const Points& loaded, const Points& elements,
                       const std::optional<Eigen::Vector3d>& ringed) {
  put(camera, clamped, clamps_);
  put(camera, loaded, loads_);
  put(camera, elements, origins_);
  ring_.setPlace(ringed ? camera.pixelOf(*ringed) : std::nullopt);
}

}  // namespace pliant::render
