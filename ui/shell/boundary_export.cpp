#include "ui/shell/boundary_export.hpp"

#include <QFileInfo>
#include <QImage>
#include <QSaveFile>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "ui/panels/boundary_panel.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

namespace {

[[noreturn]] void refuse(const QString& file, const QString& problem) {
  throw base::InputError(file.toStdString(), problem.toStdString());
}

}  // namespace

QString boundaryFilters() {
  return QStringLiteral("Picture (*.png);;Surface (*.ply *.stl *.obj *.gltf *.glb *.3mf);;Limits (*.csv)");
}

void writeBoundary(const QString& file, panels::BoundaryPanel& boundary) {
  if (!boundary.surface()) refuse(file, QStringLiteral("There is no boundary to export yet: run its study first."));
  const QString suffix = QFileInfo(file).suffix().toLower();
  const scene::BoundarySurface& surface = *boundary.surface();
  if (suffix == QLatin1String("png") || suffix == QLatin1String("csv")) {
    QSaveFile out(file);
    const bool opened = out.open(QIODevice::WriteOnly);
    const bool written = opened && (suffix == QLatin1String("png")
                                        ? boundary.viewport().grabImage().save(&out, "PNG")
                                        : out.write(QByteArray::fromStdString(boundary.result()->table())) >= 0);
    if (!written || !out.commit()) refuse(file, QStringLiteral("The file cannot be written."));
    return;
  }
  geometry::SurfaceMesh mesh;
  mesh.points = surface.points;
  mesh.triangles = surface.triangles;
  geometry::writeMesh(mesh, file.toStdString());
}

}  // namespace pliant::shell
