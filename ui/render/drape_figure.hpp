#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/cloth_result.hpp"
#include "ui/render/image.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

/// One column of the figure.
struct Drape {
  std::string title;
  std::shared_ptr<const cloth::ClothProblem> problem;  ///< null: the title alone
  std::shared_ptr<const scene::ClothFrame> frame;      ///< null: at rest
};

/// How many columns `count` drapes take, and how many rows of them.
struct DrapeGrid {
  int columns = 1, rows = 1;
};
DrapeGrid drapeGrid(std::size_t count);

/// Pixels per device-independent pixel with which the text of so many drapes suits a picture of this size.
double fittingPixelRatio(std::size_t count, int width, int height);

/// Stretch limits in polar coordinates above, what a cloth does with them below, side by side (thesis Fig. 3.2), drawn
/// without a display. Text is as large as suits `pixelRatio` pixels per device-independent pixel. Throws as
/// renderToImage() does.
Image drawDrapes(const std::vector<Drape>& drapes, int width, int height, double pixelRatio, Theme theme);

}  // namespace pliant::render
