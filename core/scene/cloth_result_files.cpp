#include <cmath>

#include "core/scene/cloth_builder.hpp"
#include "core/scene/cloth_result.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/frame_ply.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/result_folder.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

void addFinite(CsvWriter& csv, double value) { std::isfinite(value) ? csv.add(value) : csv.add(""); }

std::string stepTable(const std::vector<ClothStepRecord>& steps) {
  CsvWriter csv;
  csv.add("time [s]").add("kinetic [J]").add("membrane [J]").add("bending [J]").add("gravity [J]").add("other [J]");
  csv.add("contact [J]").add("total [J]").add("violation").add("relative gap").add("residual").add("smallest gap [m]");
  csv.add("newton iterations").add("projection iterations").add("newton [s]").add("projection [s]").add("converged");
  csv.endRow();
  for (const ClothStepRecord& step : steps) {
    const cloth::Energies& e = step.energies;
    csv.add(step.time).add(e.kinetic).add(e.membrane).add(e.bending).add(e.gravity).add(e.other).add(e.contact);
    csv.add(e.total()).add(step.violation);
    for (const double value : {step.relativeGap, step.residual, step.smallestGap}) addFinite(csv, value);
    csv.add(step.newtonIterations).add(step.projectionIterations).add(step.newtonSeconds).add(step.projectionSeconds);
    csv.add(step.converged ? 1 : 0).endRow();
  }
  return csv.text();
}

std::vector<ClothStepRecord> readSteps(std::string_view text) {
  std::vector<ClothStepRecord> steps;
  const auto numberOr = [](std::string_view cell, double otherwise) {
    return cell.empty() ? otherwise : csvNumber(cell);
  };
  for (const auto& row : readCsv(text)) {
    if (row.size() != 17) throw InputError("", "the table of steps has " + std::to_string(row.size()) + " columns");
    ClothStepRecord step;
    step.time = csvNumber(row[0]);
    step.energies = {csvNumber(row[1]), csvNumber(row[2]), csvNumber(row[3]),
                     csvNumber(row[4]), csvNumber(row[5]), csvNumber(row[6])};
    step.violation = csvNumber(row[8]);
    step.relativeGap = numberOr(row[9], std::numeric_limits<double>::infinity());
    step.residual = numberOr(row[10], std::numeric_limits<double>::infinity());
    step.smallestGap = numberOr(row[11], std::numeric_limits<double>::infinity());
    step.newtonIterations = csvInteger(row[12]);
    step.projectionIterations = csvInteger(row[13]);
    step.newtonSeconds = csvNumber(row[14]);
    step.projectionSeconds = csvNumber(row[15]);
    step.converged = csvInteger(row[16]) != 0;
    steps.push_back(step);
  }
  return steps;
}

std::string convergenceTable(const base::SolverReport& report) {
  CsvWriter csv;
  csv.add("iteration").add("relative gap").add("violation").add("step length").endRow();
  for (const base::IterationRecord& record : report.iterations) {
    csv.add(record.iteration);
    for (const double value : {record.residual, record.correction, record.stepLength}) addFinite(csv, value);
    csv.endRow();
  }
  return csv.text();
}

base::SolverReport readConvergence(std::string_view text) {
  base::SolverReport report;
  for (const auto& row : readCsv(text)) {
    if (row.size() != 4) throw InputError("", "the table of iterations has " + std::to_string(row.size()) + " columns");
    const auto number = [](std::string_view cell) {
      return cell.empty() ? std::numeric_limits<double>::infinity() : csvNumber(cell);
    };
    report.iterations.push_back({csvInteger(row[0]), number(row[1]), number(row[3]), number(row[2])});
  }
  return report;
}

std::string triangleTable(const ClothFrame& frame) {
  CsvWriter csv;
  csv.add("triangle").add("stretch over limit").add("multiplier [J s^2]").endRow();
  for (Eigen::Index t = 0; t < frame.stretchRatios.size(); ++t)
    csv.add(static_cast<long>(t)).add(frame.stretchRatios[t]).add(frame.limitForces[t]).endRow();
  return csv.text();
}

base::TerminationType terminationNamed(const std::string& name) {
  using enum base::TerminationType;
  for (const auto termination : {converged, iterationLimit, infeasible, cancelled, failed})
    if (base::toString(termination) == name) return termination;
  throw InputError("", quote(name) + " is no way in which a study ends");
}

void readClothSummary(ClothResult& result, const Json& summary) {
  if (summary.at("kind") != result.kind())
    throw InputError("", "this result is of the kind " + summary.at("kind").dump() + ", not of a cloth");
  result.termination = terminationNamed(summary.at("termination"));
  result.message = summary.at("message");
  result.seconds = summary.at("seconds");
  const Json& from = summary.at("provenance");
  result.provenance = {
      from.at("version"), from.at("scene"), from.at("scene_hash"), summary.at("study"), from.at("options")};
}

}  // namespace

void ClothResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  folder.writeFile("steps.csv", stepTable(steps));
  folder.writeFile("convergence.csv", convergenceTable(lastProjection));
  std::filesystem::create_directories(folder.path("frames"));
  CsvWriter list;
  list.add("frame").add("time [s]").endRow();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    folder.writeFile(frameFileName(i), frameToPly(*frames[i], problem->sheet));
    list.add(static_cast<long>(i)).add(frames[i]->time).endRow();
  }
  folder.writeFile("frames.csv", list.text());
  if (!frames.empty()) folder.writeFile("triangles.csv", triangleTable(*frames.back()));
  if (!frames.empty() && studyType() == "projection")
    folder.writeFile("optimum.ply", frameToPly(*frames.back(), problem->sheet));
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

std::shared_ptr<ClothResult> ClothResult::read(const Scene& scene, const std::filesystem::path& directory) {
  auto result = std::make_shared<ClothResult>();
  result->problem = buildClothProblem(scene, buildModel(scene));
  const auto inFile = [&](const std::string& name, const auto& use) {
    const std::string text = readTextFile(directory / name);
    locate((directory / name).string(), [&] { use(text); });
  };
  inFile("summary.json", [&](const std::string& text) {
    try {
      readClothSummary(*result, parseJson(text));
    } catch (const Json::exception&) {
      throw InputError("", "this is no summary of a result, or it is damaged");
    }
  });
  inFile("steps.csv", [&](const std::string& text) { result->steps = readSteps(text); });
  inFile("convergence.csv", [&](const std::string& text) { result->lastProjection = readConvergence(text); });
  std::vector<double> times;
  inFile("frames.csv", [&](const std::string& text) {
    for (const auto& row : readCsv(text)) times.push_back(csvNumber(row.back()));
  });
  for (std::size_t i = 0; i < times.size(); ++i)
    inFile(frameFileName(i), [&](const std::string& text) {
      ClothFrame frame = frameFromPly(text, result->problem->sheet);
      frame.time = times[i];
      const double bodiesAt =
          result->studyType() == "cloth_motion" ? times[i] : result->provenance.options.value("time", 0.0);
      frame.bodyPoints = cloth::bodyPointsAt(*result->problem, bodiesAt);
      result->frames.push_back(std::make_shared<const ClothFrame>(std::move(frame)));
    });
  return result;
}

}  // namespace pliant::scene
