#include "ui/shell/exporter.hpp"

#include <QFileInfo>
#include <QImage>
#include <QSaveFile>
#include <QTextStream>

#include "core/base/error.hpp"
#include "core/geometry/mesh_animation.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/scene/model_builder.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

namespace {

[[noreturn]] void fail(const QString& file, const QString& problem) {
  throw base::InputError(file.toStdString(), problem.toStdString());
}

geometry::SurfaceMesh frameMesh(const cloth::ClothProblem& problem, const scene::ClothFrame& frame) {
  mechanics::Vector positions = problem.model->restPositions;
  positions.head(frame.positions.size()) = frame.positions.reshaped();
  return scene::surfaceAt(*problem.model, positions);
}

geometry::SurfaceMesh deformedMesh(const document::Document& document, const jobs::MotionSession& session,
                                   viewport::Viewport& viewport) {
  const int frame = viewport.showsCloth() ? viewport.clothView().frame() : -1;
  if (frame >= 0)
    return frameMesh(*viewport.clothProblem(), *viewport.clothFrames().at(static_cast<std::size_t>(frame)));
  const double tau = viewport.tau();
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
    const geometry::SurfaceMesh mesh = deformedMesh(document, session, viewport);
    if (mesh.triangles.empty()) fail(file, QStringLiteral("This scene has no triangles to export."));
    geometry::writeMesh(mesh, file.toStdString());
  }
}

QString frameExportFilters() { return QStringLiteral("Animation (*.glb);;Numbered meshes (*.obj *.ply *.stl)"); }

std::function<int(base::ExecutionContext&)> frameExport(const QString& file, viewport::Viewport& viewport) {
  if (!viewport.showsCloth() || viewport.clothFrames().empty())
    fail(file, QStringLiteral("There are no frames of a cloth to export yet: run its study first."));
  const QFileInfo target(file);
  const QString suffix = target.suffix().toLower();
  const auto problem = viewport.clothProblem();
  const auto frames = viewport.clothFrames();
  if (suffix == QLatin1String("glb"))
    return [problem, frames, file](base::ExecutionContext&) {
      geometry::MeshAnimation animation;
      animation.triangles = frameMesh(*problem, *frames.front()).triangles;
      for (const auto& frame : frames) {
        animation.frames.push_back(frameMesh(*problem, *frame).points);
        animation.times.push_back(frame->time);
      }
      geometry::writeAnimation(animation, file.toStdString());
      return 1;
    };
  if (suffix != QLatin1String("obj") && suffix != QLatin1String("ply") && suffix != QLatin1String("stl"))
    fail(file, QStringLiteral("The file's name must end in .glb, .obj, .ply or .stl."));
  return [problem, frames, suffix,
          base = target.absolutePath() + '/' + target.completeBaseName()](base::ExecutionContext& context) {
    int written = 0;
    for (const auto& frame : frames) {
      if (context.cancelRequested()) break;
      const QString name = QStringLiteral("%1_%2.%3").arg(base).arg(written, 5, 10, QLatin1Char('0')).arg(suffix);
      geometry::writeMesh(frameMesh(*problem, *frame), name.toStdString());
      ++written;
      context.reportProgress(static_cast<double>(written) / static_cast<double>(frames.size()), "");
    }
    return written;
  };
}

}  // namespace pliant::shell
