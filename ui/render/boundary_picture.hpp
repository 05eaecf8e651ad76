#pragma once

#include "ui/render/boundary_view.hpp"
#include "ui/render/limit_view.hpp"
#include "ui/render/offscreen.hpp"
#include "ui/render/patch_view.hpp"

namespace pliant::render {

/// What a still picture of boundaries shows.
struct BoundaryScenery {
  std::shared_ptr<const scene::BoundarySurface> surface;
  std::shared_ptr<const scene::BoundarySurface> compared;  ///< or null
  BoundaryStyle style;
};

/// Draws a boundary without a display, as renderToImage() does.
Image drawBoundary(const BoundaryScenery& scenery, const PictureOptions& options);

/// Draws a patch in its equilibrium without a display, as renderToImage() does.
Image drawPatch(const std::shared_ptr<const PatchConfiguration>& configuration, const PictureOptions& options);

/// Draws a cell at its limit without a display, as renderToImage() does.
Image drawConfiguration(const std::shared_ptr<const CellConfiguration>& configuration, const PictureOptions& options);

}  // namespace pliant::render
