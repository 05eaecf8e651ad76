#pragma once

#include <QString>

#include "ui/jobs/motion_session.hpp"

namespace pliant::viewport {
class Viewport;
}

namespace pliant::shell {

/// The name filters of the export dialog.
QString exportFilters();

/// Writes what is shown into `file`, by its extension: a picture (png), the mesh deformed as at τ [rad] (stl, obj, ply,
/// gltf, glb, 3mf), or the curve of `study` with every probe's amplitude (csv). Throws base::InputError.
void exportTo(const QString& file, const document::Document& document, const jobs::MotionSession& session,
              const std::string& study, viewport::Viewport& viewport);

}  // namespace pliant::shell
