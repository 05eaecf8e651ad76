#include "ui/shell/exporter.hpp"

#include <QCoreApplication>
#include <QFileInfo>
#include <QImage>
#include <QSaveFile>
#include <QTextStream>
#include <filesystem>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/motion_animation.hpp"
#include "ui/render/film.hpp"
#include "ui/render/macro_view.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

namespace {

[[noreturn]] void fail(const QString& file, const QString& problem) {
  throw base::InputError(file.toStdString(), problem.toStdString());
}

/// Null: no sheet of interlocking material is on show.
std::shared_ptr<const render::MacroView> sheetOnShow(const viewport::Viewport& viewport) {
  const auto view = std::dynamic_pointer_cast<const render::MacroView>(viewport.guest());
  return view && view->result() ? view : nullptr;
}

/// What is recorded, as meshes.
struct MeshFrames {
  std::vector<double> times;
  std::function<geometry::SurfaceMesh(std::size_t)> mesh;
};

MeshFrames meshFrames(const viewport::Viewport& viewport) {
  MeshFrames meshes;
  const auto gather = [&](const auto& frames) {
    for (const auto& frame : frames) meshes.times.push_back(frame->time);
  };
  if (const auto view = sheetOnShow(viewport)) {
    gather(view->result()->frames);
    meshes.mesh = [result = view->result()](std::size_t frame) {
      geometry::SurfaceMesh mesh = result->sheet->mesh;
      mesh.points = result->frames[frame]->positions;
      return mesh;
    };
  } else {
    gather(viewport.clothFrames());
    meshes.mesh = [problem = viewport.clothProblem(), frames = viewport.clothFrames()](std::size_t frame) {
      return scene::clothMesh(*problem, *frames[frame]);
    };
  }
  return meshes;
}

geometry::SurfaceMesh deformedMesh(const document::Document& document, const jobs::MotionSession& session,
                                   viewport::Viewport& viewport) {
  if (const auto sheet = sheetOnShow(viewport)) return sheet->mesh();
  const int frame = viewport.showsCloth() ? viewport.clothView().frame() : -1;
  if (frame >= 0)
    return scene::clothMesh(*viewport.clothProblem(), *viewport.clothFrames().at(static_cast<std::size_t>(frame)));
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

FrameExport filmExport(const std::filesystem::path& file, const jobs::MotionSession& session,
                       const viewport::Viewport& viewport) {
  render::FilmOptions film = viewport.filmOptions();
  if (const auto view = sheetOnShow(viewport)) {
    film.macroField = view->field();
    film.selectedTriangle = view->selectedTriangle();
    auto sheet = std::make_shared<scene::MacroResult>(*view->result());
    if (!view->nativeVisible()) sheet->native.reset();
    return [file, film, sheet](base::ExecutionContext& context) {
      const auto made = render::filmMacro(sheet, film, file, context);
      return made ? made->files : 0;
    };
  }
  if (viewport.showsCloth())
    return [file, film, problem = viewport.clothProblem(), frames = viewport.clothFrames(),
            clock = viewport.frameClock()](base::ExecutionContext& context) {
      const auto made = render::filmCloth(problem, frames, clock, film, file, context);
      return made ? made->files : 0;
    };
  const jobs::ShownMotion& shown = *session.shown();
  const double period = 2 * std::numbers::pi * shown.problem->drivePeriods() / shown.motion.omega;
  film.speed = viewport.speed() * period / shown.problem->basis().periods();
  return [file, film, period, problem = shown.problem, z = shown.motion.z](base::ExecutionContext& context) {
    const auto made = render::filmMotion(problem, z, period, film, file, context);
    return made ? made->files : 0;
  };
}

FrameExport animationExport(const std::filesystem::path& file, const jobs::MotionSession& session,
                            const viewport::Viewport& viewport) {
  if (viewport.showsFrames())
    return [file, frames = meshFrames(viewport)](base::ExecutionContext& context) {
      geometry::MeshAnimation animation;
      animation.times = frames.times;
      for (std::size_t i = 0; i < frames.times.size(); ++i) {
        if (context.cancelRequested()) return 0;
        geometry::SurfaceMesh mesh = frames.mesh(i);
        animation.triangles = std::move(mesh.triangles);
        animation.frames.push_back(std::move(mesh.points));
      }
      geometry::writeAnimation(animation, file);
      return 1;
    };
  const jobs::ShownMotion& shown = *session.shown();
  return [file, seconds = shown.problem->basis().periods() / viewport.speed(), problem = shown.problem,
          z = shown.motion.z](base::ExecutionContext& context) {
    if (context.cancelRequested()) return 0;
    geometry::writeAnimation(scene::periodAnimation(*problem, z, scene::animationSteps(seconds), seconds), file);
    return 1;
  };
}

/// Written into a folder that goes in any case; the meshes are taken out of it when all are there.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::filesystem::path& file)
      : path_(file.parent_path() /
              ("." + file.filename().string() + ".writing-" + std::to_string(QCoreApplication::applicationPid()))) {
    std::error_code error;
    std::filesystem::create_directory(path_, error);
    if (error) throw base::InputError(file.string(), "The files cannot be written: " + error.message() + ".");
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void emptyInto(const std::filesystem::path& place) const {
    const std::vector<std::filesystem::path> files(std::filesystem::directory_iterator(path_), {});
    for (const std::filesystem::path& file : files) {
      std::error_code error;
      std::filesystem::rename(file, place / file.filename(), error);
      if (error) throw base::InputError((place / file.filename()).string(), error.message() + ".");
    }
  }

 private:
  std::filesystem::path path_;
};

FrameExport meshExport(const std::filesystem::path& file, const viewport::Viewport& viewport) {
  return [file, frames = meshFrames(viewport)](base::ExecutionContext& context) {
    const TemporaryFolder folder(file);
    int written = 0;
    for (std::size_t i = 0; i < frames.times.size(); ++i) {
      if (context.cancelRequested()) return 0;
      const QString name = QStringLiteral("%1_%2%3")
                               .arg(QString::fromStdString(file.stem().string()))
                               .arg(written++, 5, 10, QLatin1Char('0'))
                               .arg(QString::fromStdString(file.extension().string()));
      geometry::writeMesh(frames.mesh(i), folder.path() / name.toStdString());
      context.reportProgress(static_cast<double>(written) / static_cast<double>(frames.times.size()));
    }
    folder.emptyInto(file.parent_path());
    return written;
  };
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

QString frameExportFilters(const viewport::Viewport& viewport) {
  const QString films = QStringLiteral("Video (*.ogv);;Numbered pictures (*.png)");
  const QString animated = films + QStringLiteral(";;Animation (*.glb)");
  return viewport.showsFrames() ? animated + QStringLiteral(";;Numbered meshes (*.obj *.ply *.stl)") : animated;
}

FrameExport frameExport(const QString& file, const jobs::MotionSession& session, const viewport::Viewport& viewport) {
  const QString suffix = QFileInfo(file).suffix().toLower();
  if (viewport.isLive()) fail(file, QStringLiteral("A live cloth has no frames to export until it is recorded."));
  const bool frames = viewport.showsFrames() && (!viewport.showsCloth() || !viewport.clothFrames().empty());
  const bool still = viewport.showsCloth() || sheetOnShow(viewport);
  const bool film = suffix == QLatin1String("ogv") || suffix == QLatin1String("png");
  if (!frames && (still || !session.shown()))
    fail(file, QStringLiteral("There is no motion to export yet: run its study first."));
  if (film) return filmExport(file.toStdString(), session, viewport);
  if (suffix == QLatin1String("glb")) return animationExport(file.toStdString(), session, viewport);
  if (!frames) fail(file, QStringLiteral("The file's name must end in .ogv, .png or .glb."));
  if (suffix == QLatin1String("obj") || suffix == QLatin1String("ply") || suffix == QLatin1String("stl"))
    return meshExport(file.toStdString(), viewport);
  fail(file, QStringLiteral("The file's name must end in .ogv, .png, .glb, .obj, .ply or .stl."));
}

}  // namespace pliant::shell
