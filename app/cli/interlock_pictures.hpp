#pragma once

#include <optional>

#include "app/cli/commands.hpp"

namespace pliant::cli {

/// Draws the boundary, the configuration at a limit, or the polar plot that the options ask for; nothing if what they
/// ask for is no result of an interlocking material. Throws base::InputError.
std::optional<ExitStatus> renderInterlock(const MotionOptions& options, const BoundaryLook& look,
                                          const std::string& size);

/// The polar plots of all free travel among the results; nothing if there is none. Throws base::InputError.
std::optional<ExitStatus> plotInterlock(const PlotOptions& options, const std::string& size);

/// Writes a boundary as a surface in Green strain; nothing if the options ask for something else. Throws
/// base::InputError.
std::optional<ExitStatus> exportBoundary(const MotionOptions& options);

}  // namespace pliant::cli
