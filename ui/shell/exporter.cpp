#include "ui/shell/exporter.hpp"

#include <QFileInfo>
#include <QImage>
#include <QSaveFile>
#include <QTextStream>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/scene/model_builder.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

namespace {

[[noreturn]] void fail(const QString& file, const QString& problem) {
  throw base::InputError(file.toStdString(), problem.toStdString());
}

geometry::SurfaceMesh deformedMesh(const document::Document& document, const jobs::MotionSession& session, double tau) {
  const mechanics::Model& model = *document.model();
  const auto& shown = session.shown();
  const bool moves = shown && shown->problem->model().nodeCount() == model.nodeCount();
  const mechanics::Vector positions =
      moves ? shown->problem->configurationAt(shown->motion.z, tau) : model.restPositions;
  return scene::surfaceAt(model, positions);
}

void writeCurve(const QString& file, const document::Document& document, const std::string& study) {
  const document::StudyState* state = document.study(study);
  const auto result = state ? std::dynamic_pointer_cast<const scene::HarmonicResult>(state->result) : nullptr;
  if (!result) fail(file, QStringLiteral("There is no frequency-response curve to export yet: run its study first."));
  QSaveFile out(file);
  if (!out.open(QIODevice::WriteOnly | QIODevice::Text)) fail(file, QStringLiteral("The file cannot be written."));
  QTextStream text(&out);
  text.setRealNumberPrecision(17);
  text << "omega [rad/s]";
  for (const auto& probe : result->problem->model().probes)
    text << ',' << probe.name.c_str() << " path length [m]," << probe.name.c_str() << " maximum displacement [m]";
  text << '\n';
  for (const auto& point : result->points) {
    text << point.omega;
    for (const auto& amplitude : point.amplitudes)
      text << ',' << amplitude.pathLength << ',' << amplitude.maximumDisplacement;
    text << '\n';
  }
  text.flush();
  if (!out.commit()) fail(file, QStringLiteral("The file cannot be written."));
}

}  // namespace

QString exportFilters() {
  return QStringLiteral(
      "Picture of the viewport (*.png);;Deformed mesh (*.stl *.obj *.ply *.gltf *.glb *.3mf);;"
      "Frequency-response curve (*.csv)");
}

void exportTo(const QString& file, const document::Document& document, const jobs::MotionSession& session,
              const std::string& study, viewport::Viewport& viewport) {
  const QString suffix = QFileInfo(file).suffix().toLower();
  if (suffix == QLatin1String("png")) {
    QSaveFile out(file);
    if (!out.open(QIODevice::WriteOnly) || !viewport.grabImage().save(&out, "PNG") || !out.commit())
      fail(file, QStringLiteral("The picture cannot be written."));
  } else if (suffix == QLatin1String("csv")) {
    writeCurve(file, document, study);
  } else {
    const geometry::SurfaceMesh mesh = deformedMesh(document, session, viewport.tau());
    if (mesh.triangles.empty()) fail(file, QStringLiteral("This scene has no triangles to export."));
    geometry::writeMesh(mesh, file.toStdString());
  }
}

}  // namespace pliant::shell
