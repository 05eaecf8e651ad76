#include <algorithm>
#include <cmath>

#include "ui/render/offscreen_target.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::viewport {
namespace {

constexpr double lowestFilm = 720;  // pixels

/// Video players prefer even sizes.
int even(double pixels) {
  return std::clamp(2 * static_cast<int>(std::lround(0.5 * pixels)), 2, render::OffscreenTarget::largestSide);
}

}  // namespace

render::FilmOptions Viewport::filmOptions() const {
  render::FilmOptions film;
  film.pixelRatio = std::max(devicePixelRatioF(), lowestFilm / std::max(1, height()));
  film.picture.width = even(film.pixelRatio * width());
  film.picture.height = even(film.pixelRatio * height());
  film.picture.theme = theme();
  film.picture.caption = view_->caption();
  film.picture.selectedNode = selectedNode();
  film.camera = view_->cameraPose();
  film.fieldVisible = view_->fieldVisible();
  film.field = cloth_.field();
  film.directionsVisible = cloth_.directionsVisible();
  if (showsFrames()) film.speed = clothSpeed_;
  return film;
}

}  // namespace pliant::viewport
