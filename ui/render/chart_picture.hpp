#pragma once

#include <filesystem>
#include <vector>

#include "core/scene/result_charts.hpp"
#include "ui/render/image.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

/// Draws charts side by side, without a display. Throws as renderToImage().
Image chartImage(const std::vector<scene::ResultChart>& charts, int width, int height, Theme theme);

/// The same into a PNG file of `width` x `height` pixels.
void drawCharts(const std::vector<scene::ResultChart>& charts, int width, int height, Theme theme,
                const std::filesystem::path& file);

}  // namespace pliant::render
