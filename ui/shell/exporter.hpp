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

/// The name filters of the dialog that exports all frames.
QString frameExportFilters();

/// All frames of the cloth on show, to be written on any thread: into one animated file (glb), or into numbered files
/// beside `file` (obj, ply, stl): sheet.obj gives sheet_00000.obj, ... Throws base::InputError if there is no cloth, or
/// for another extension; the work does so too, and returns how many files it wrote.
std::function<int(base::ExecutionContext&)> frameExport(const QString& file, viewport::Viewport& viewport);

}  // namespace pliant::shell
