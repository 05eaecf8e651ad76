#include "ui/shell/parts_exporter.hpp"

#include <numbers>

#include "core/scene/parts_export.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

namespace {

/// So many times of a period are looked at for links that meet.
constexpr int samplesOfPeriod = 32;

}  // namespace

PartsExport partsExport(const QString& file, const document::Document& document, const jobs::MotionSession& session,
                        viewport::Viewport& viewport, const scene::PartsRequest& request) {
  const std::shared_ptr<const mechanics::Model> model = document.model();
  mechanics::Vector positions = model->restPositions;
  const int frame = viewport.showsCloth() ? viewport.clothView().frame() : -1;
  std::function<std::vector<mechanics::Vector>()> motion = [] { return std::vector<mechanics::Vector>(); };
  const auto& shown = session.shown();
  if (frame >= 0) {
    const auto& nodes = viewport.clothFrames().at(static_cast<std::size_t>(frame))->positions;
    positions.head(nodes.size()) = nodes.reshaped();
  } else if (shown && shown->problem->model().nodeCount() == model->nodeCount()) {
    positions = shown->problem->configurationAt(shown->motion.z, viewport.tau());
    motion = [problem = shown->problem, z = shown->motion.z] {
      std::vector<mechanics::Vector> moments;
      const int samples = samplesOfPeriod * problem->basis().periods();
      for (int i = 0; i < samples; ++i)
        moments.push_back(problem->configurationAt(z, 2 * std::numbers::pi * i / samples));
      return moments;
    };
  }
  return [file = file.toStdString(), scene = document.scene(), model, positions, motion,
          request](base::ExecutionContext& context) {
    QStringList lines;
    const auto report = scene::exportParts({scene, *model, positions, motion()}, request, file, context);
    if (report)
      for (const std::string& line : linesOf(*report)) lines += QString::fromStdString(line);
    return lines;
  };
}

}  // namespace pliant::shell
