#pragma once

#include <filesystem>
#include <vector>

#include "core/scene/result_charts.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

/// Draws charts side by side into a PNG file of `width` x `height` pixels, without a display. Throws as renderToPng().
void drawCharts(const std::vector<scene::ResultChart>& charts, int width, int height, Theme theme,
                const std::filesystem::path& file);

}  // namespace pliant::render
