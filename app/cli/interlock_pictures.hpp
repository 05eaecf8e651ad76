#pragma once

#include <optional>

#include "app/cli/commands.hpp"
#include "core/scene/macro_result.hpp"

namespace pliant::cli {

/// Draws the boundary, the configuration at a limit, the patch in its equilibrium, or the plot that the options ask
/// for; nothing if what they ask for is no result of an interlocking material. Throws base::InputError.
std::optional<ExitStatus> renderInterlock(const MotionOptions& options, const BoundaryLook& look,
                                          const std::string& size);

/// The motion of a sheet that the options ask for; null if they ask for something else. Throws base::InputError.
std::shared_ptr<const scene::MacroResult> findSheetMotion(const MotionOptions& options);

/// The plots of all limits over directions or sizes among the results; nothing if there are none. Throws
/// base::InputError.
std::optional<ExitStatus> plotInterlock(const PlotOptions& options, const std::string& size);

/// Writes a boundary as a surface in Green strain or curvature, or its limits as a table; nothing if the options ask
/// for something else. Throws base::InputError.
std::optional<ExitStatus> exportBoundary(const MotionOptions& options);

}  // namespace pliant::cli
