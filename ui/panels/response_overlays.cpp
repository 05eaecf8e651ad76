#include "ui/panels/response_overlays.hpp"

#include <QFileInfo>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/study.hpp"

namespace pliant::panels {

namespace {

using base::InputError;

/// SI units in one of the unit that a column's header gives in brackets.
double unitOfColumn(std::string_view header, const base::Dimension& dimension, const std::string& example) {
  const auto open = header.find('['), close = header.find(']');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open)
    throw InputError("", "The header of a column must give its unit in brackets, such as \"" + example + "\".");
  return base::parseQuantity("1 " + std::string(header.substr(open + 1, close - open - 1)), dimension);
}

std::vector<std::string_view> headerOf(std::string_view text) {
  std::vector<std::string_view> columns;
  std::string_view line = text.substr(0, text.find('\n'));
  for (std::size_t comma; (comma = line.find(',')) != std::string_view::npos; line.remove_prefix(comma + 1))
    columns.push_back(line.substr(0, comma));
  columns.push_back(line);
  return columns;
}

}  // namespace

int probeOf(const mechanics::Model& model, int node) {
  for (std::size_t i = 0; i < model.probes.size(); ++i)
    if (model.probes[i].node == node) return static_cast<int>(i);
  return -1;
}

std::vector<plots::ResponseOverlay> studyOverlays(const document::Document& document, const std::string& shown,
                                                  int node, jobs::AmplitudeMeasure measure) {
  std::vector<plots::ResponseOverlay> overlays;
  for (const document::StudyState& study : document.studies()) {
    const auto* result = dynamic_cast<const scene::HarmonicResult*>(study.result.get());
    // A single periodic motion is what the plot's own marker shows.
    if (!result || study.name == shown || study.stale || study.type == "periodic_motion") continue;
    const int probe = probeOf(result->problem->model(), node);
    if (probe < 0) continue;
    const auto index = static_cast<std::size_t>(probe);
    plots::ResponseOverlay overlay;
    overlay.name = QString::fromStdString(study.name);
    overlay.dots = result->points.size() < 2;
    for (const harmonic::ResponsePoint& point : result->points) {
      if (index >= point.amplitudes.size()) continue;
      const harmonic::Amplitude& amplitude = point.amplitudes[index];
      overlay.omega.push_back(point.omega);
      overlay.amplitude.push_back(measure == jobs::AmplitudeMeasure::pathLength ? amplitude.pathLength
                                                                                : amplitude.maximumDisplacement);
    }
    if (!overlay.omega.empty()) overlays.push_back(std::move(overlay));
  }
  return overlays;
}

plots::ResponseOverlay readMeasurements(const QString& file) {
  try {
    const std::string text = scene::readTextFile(file.toStdString());
    const std::vector<std::string_view> header = headerOf(text);
    if (header.size() < 2) throw InputError("", "The table needs a column of frequencies and one of amplitudes.");
    const double perFrequency = unitOfColumn(header[0], base::dimensions::angularFrequency, "frequency [Hz]");
    const double perAmplitude = unitOfColumn(header[1], base::dimensions::length, "amplitude [mm]");
    plots::ResponseOverlay overlay;
    overlay.name = QFileInfo(file).completeBaseName();
    overlay.dots = true;
    for (const std::vector<std::string_view>& row : scene::readCsv(text)) {
      overlay.omega.push_back(scene::csvNumber(row[0]) * perFrequency);
      overlay.amplitude.push_back(scene::csvNumber(row[1]) * perAmplitude);
    }
    if (overlay.omega.empty()) throw InputError("", "The table has no rows.");
    return overlay;
  } catch (const InputError& error) {
    throw error.inside(file.toStdString());
  }
}

}  // namespace pliant::panels
