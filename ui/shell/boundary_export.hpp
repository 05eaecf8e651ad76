#pragma once

#include <QString>

namespace pliant::panels {
class BoundaryPanel;
}

namespace pliant::shell {

/// The name filters of the dialog that exports a boundary.
QString boundaryFilters();

/// Writes the boundary on show by the file's extension: a picture as it is seen (png), its surface in Green strain
/// (ply, stl, obj, gltf, glb, 3mf), or a row a limit (csv). Throws base::InputError.
void writeBoundary(const QString& file, panels::BoundaryPanel& boundary);

}  // namespace pliant::shell
