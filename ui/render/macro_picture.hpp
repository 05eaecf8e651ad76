#pragma once

#include "ui/render/macro_view.hpp"
#include "ui/render/offscreen.hpp"

namespace pliant::render {

/// Of one frame: when it is, or under which part of its loads, and how near it comes to its limits.
std::string macroFrameLine(const scene::MacroFrame& frame, bool isMotion);
/// Of elements beside their sheet, which are off it by this distance [m].
std::string nativeCaption(const scene::NativeComparison& native, double meanDistance);
/// The numbers that belong to it, in lines; of a motion the worst of all its steps.
/// With the native patch beside it its numbers are left out.
std::string macroCaption(const scene::MacroResult& result, bool nativeBeside = false);

/// Draws it without a display, as renderToImage() does; of a motion the frame nearest to `time` [s], of placed elements
/// these if asked for.
Image drawMacro(const std::shared_ptr<const scene::MacroResult>& result, const PictureOptions& options,
                std::optional<double> time = std::nullopt, bool elements = false);

}  // namespace pliant::render
