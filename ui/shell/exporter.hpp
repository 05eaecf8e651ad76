#pragma once

#include <QString>
#include <functional>

#include "ui/jobs/motion_session.hpp"

namespace pliant::viewport {
class Viewport;
}

namespace pliant::shell {

/// The name filters of the export dialog.
QString exportFilters();

/// Writes what is shown into `file`, by its extension: a picture (png), the mesh deformed as at τ [rad], or as in the
/// frame of a cloth on show (stl, obj, ply, gltf, glb, 3mf), or the curve of `study` with every probe's amplitude
/// (csv). Throws base::InputError.
void exportTo(const QString& file, const document::Document& document, const jobs::MotionSession& session,
              const std::string& study, viewport::Viewport& viewport);

/// The name filters of the dialog that exports all of a motion.
QString frameExportFilters(const viewport::Viewport& viewport);

/// Work for any thread; returns how many files it wrote, 0 once cancelled. Throws base::InputError.
using FrameExport = std::function<int(base::ExecutionContext&)>;

/// All frames of the cloth on show, or one period of the motion on show: as a video (ogv) or numbered pictures (png:
/// sheet.png gives sheet_00000.png, ...) that look and play as the viewport does, and of a cloth as one animated file
/// (glb) or numbered meshes (obj, ply, stl). A cancelled or failed export leaves no file. Throws base::InputError if
/// nothing moves, or for another extension.
FrameExport frameExport(const QString& file, const jobs::MotionSession& session, const viewport::Viewport& viewport);

}  // namespace pliant::shell
