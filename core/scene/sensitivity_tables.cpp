#include "core/scene/sensitivity_tables.hpp"

#include <limits>

#include "core/base/error.hpp"
#include "core/scene/csv.hpp"

namespace pliant::scene {

using harmonic::PeakSensitivity;
using harmonic::PointKind;
using harmonic::ResponsePoint;
using mechanics::Model;

namespace {

constexpr std::size_t columnsOfPeakTable = 12;

void forEachPeak(const HarmonicResult& result, const std::function<void(const ResponsePoint&)>& visit) {
  for (const ResponsePoint& point : result.points)
    if (point.kind == PointKind::peak) visit(point);
}

}  // namespace

std::shared_ptr<const PeakSensitivities> computePeakSensitivities(const HarmonicResult& result,
                                                                  base::ExecutionContext& context) {
  auto table = std::make_shared<PeakSensitivities>();
  std::vector<int> parameters(result.problem->model().parameters.size());
  for (std::size_t p = 0; p < parameters.size(); ++p) parameters[p] = static_cast<int>(p);
  forEachPeak(result, [&](const ResponsePoint& point) {
    if (context.cancelRequested()) return;
    table->peaks.push_back(harmonic::peakSensitivity(*result.problemOf(point), point, parameters));
    if (!table->peaks.back())
      context.log(base::Severity::warning, "How the peak at " + std::to_string(point.omega) +
                                               " rad/s moves with the parameters cannot be told: it is flat, or two "
                                               "curves cross there.");
  });
  return table;
}

void addPeakSensitivities(const HarmonicResult& result, Json& peaks) {
  const Model& model = result.problem->model();
  for (std::size_t i = 0; i < result.peakSensitivities->peaks.size(); ++i) {
    const auto& peak = result.peakSensitivities->peaks[i];
    if (!peak) continue;
    Json list = Json::array();
    for (std::size_t p = 0; p < model.parameters.size(); ++p) {
      const auto at = static_cast<Eigen::Index>(p);
      Json entry{{"parameter", model.parameters[p]->name()}, {"frequency_derivative", peak->omegaDerivative[at]}};
      if (peaks[i].contains("probe")) entry["path_length_derivative"] = peak->amplitudeDerivative[at];
      list.push_back(entry);
    }
    peaks[i]["sensitivities"] = list;
  }
}

std::string peakSensitivityTable(const HarmonicResult& result) {
  const Model& model = result.problem->model();
  CsvWriter csv;
  csv.add("peak").add("peak of").add("branch").add("omega [rad/s]").add("amplitude [m]").add("residual");
  csv.add("parameter").add("pointer").add("unit").add("value");
  csv.add("omega derivative [rad/s/unit]").add("amplitude derivative [m/unit]").endRow();
  std::size_t index = 0;
  forEachPeak(result, [&](const ResponsePoint& point) {
    const std::size_t i = index++;
    if (i >= result.peakSensitivities->peaks.size() || !result.peakSensitivities->peaks[i]) return;
    const PeakSensitivity& peak = *result.peakSensitivities->peaks[i];
    for (std::size_t p = 0; p < model.parameters.size(); ++p) {
      const auto at = static_cast<Eigen::Index>(p);
      csv.add(static_cast<long>(i));
      csv.add(point.probe < 0 ? std::string_view() : model.probes[static_cast<std::size_t>(point.probe)].name);
      csv.add(point.branch).add(peak.omega).add(peak.amplitude).add(peak.residual);
      csv.add(model.parameters[p]->name()).add(model.parameters[p]->pointer());
      csv.add(base::siUnit(model.parameters[p]->dimension())).add(model.parameters[p]->value(model));
      csv.add(peak.omegaDerivative[at]).add(peak.amplitudeDerivative[at]).endRow();
    }
  });
  return csv.text();
}

std::shared_ptr<const PeakSensitivities> readPeakSensitivities(const HarmonicResult& result, const std::string& table) {
  const auto& parameters = result.problem->model().parameters;
  auto read = std::make_shared<PeakSensitivities>();
  forEachPeak(result, [&](const ResponsePoint&) { read->peaks.emplace_back(); });
  const auto rows = readCsv(table);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    const auto peak =
        row.size() == columnsOfPeakTable ? static_cast<std::size_t>(csvInteger(row[0])) : read->peaks.size();
    const std::size_t p = i % parameters.size();
    if (peak >= read->peaks.size() || row[6] != parameters[p]->name() || rows.size() % parameters.size() != 0)
      throw base::InputError("", "The table of peaks does not fit the response curve beside it.");
    if (p == 0) {
      PeakSensitivity& entry = read->peaks[peak].emplace();
      entry.omega = csvNumber(row[3]);
      entry.amplitude = csvNumber(row[4]);
      entry.residual = csvNumber(row[5]);
      entry.omegaDerivative = entry.amplitudeDerivative =
          mechanics::Vector::Zero(static_cast<Eigen::Index>(parameters.size()));
    }
    read->peaks[peak]->omegaDerivative[static_cast<Eigen::Index>(p)] = csvNumber(row[10]);
    read->peaks[peak]->amplitudeDerivative[static_cast<Eigen::Index>(p)] = csvNumber(row[11]);
  }
  return read;
}

std::string sensitivityTable(const HarmonicResult& result) {
  const Model& model = result.problem->model();
  CsvWriter csv;
  csv.add("parameter").add("pointer").add("unit").add("value");
  for (const auto& probe : model.probes) csv.add(probe.name + " path length derivative [m/unit]");
  csv.endRow();
  mechanics::Matrix derivatives(model.probes.size(), model.parameters.size());
  for (std::size_t i = 0; i < model.probes.size(); ++i)
    derivatives.row(static_cast<Eigen::Index>(i)) =
        harmonic::pathLengthGradient(*result.problem, result.points.front().z, model.probes[i].node).transpose() *
        result.sensitivity->derivative();
  for (std::size_t p = 0; p < model.parameters.size(); ++p) {
    const auto& parameter = *model.parameters[p];
    csv.add(parameter.name()).add(parameter.pointer()).add(base::siUnit(parameter.dimension()));
    csv.add(parameter.value(model));
    for (Eigen::Index i = 0; i < derivatives.rows(); ++i) csv.add(derivatives(i, static_cast<Eigen::Index>(p)));
    csv.endRow();
  }
  return csv.text();
}

}  // namespace pliant::scene
