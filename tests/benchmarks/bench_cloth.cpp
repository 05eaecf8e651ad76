#include "tests/benchmarks/bench_cloth.hpp"

#include <cmath>
#include <cstdio>
#include <map>

#include "core/math/parallel.hpp"
#include "tests/benchmarks/projection_contest.hpp"
#include "tests/core/cloth/cloth_examples.hpp"

namespace pliant::bench {

namespace {

using base::Json;
using cloth::SteppingScheme;

/// Seconds of the thesis (Table 3.1); 0: it has none, or its solver failed.
struct ThesisTimes {
  double newton = 0;
  std::map<double, double> cone, ipopt, gaussSeidel;  ///< by limit
};

struct SheetSize {
  int cells;
  int steps;    ///< of 0.01 s
  int skipped;  ///< steps that are not measured: the sheet only begins to fall
  int every;    ///< other contenders than the first are measured on one of so many projections
  ThesisTimes thesis;
};

const std::vector<SheetSize>& sizes() {
  static const std::vector<SheetSize> list = {
      {10,
       100,
       0,
       1,
       {0.017, {{0.01, 0.108}, {0.1, 0.107}}, {{0.01, 0.436}, {0.1, 0.405}}, {{0.01, 0.422}, {0.1, 0.016}}}},
      {20,
       100,
       0,
       2,
       {0.064, {{0.01, 0.285}, {0.1, 0.278}}, {{0.01, 21.009}, {0.1, 27.001}}, {{0.01, 7.184}, {0.1, 0.238}}}},
      {40, 40, 20, 5, {0.361, {{0.01, 1.289}, {0.1, 1.242}}, {}, {{0.01, 54.725}, {0.1, 6.311}}}},
      {60, 24, 16, 4, {1.318, {{0.01, 4.060}, {0.1, 3.790}}, {}, {{0.01, 100.033}, {0.1, 48.427}}}},
      {100, 12, 8, 4, {}},
      {150, 8, 6, 4, {}}};
  return list;
}

cloth::SteppingOptions steppingOptions(SteppingScheme scheme) {
  cloth::SteppingOptions options;
  options.scheme = scheme;
  options.timeStep = 0.01;
  options.projection.cone.relativeGap = 1e-7;
  return options;
}

/// From the horizontal plane, held at two corners.
cloth::ClothProblem swingingSheet(int cells, double limit) {
  return test::withLimit(
      test::withGravity(test::hungByCorners(test::sheetProblem(cells)), Eigen::Vector3d(0, 0, -9.81)), 1 + limit);
}

double timeOf(const std::map<double, double>& times, double limit) {
  const auto found = times.find(limit);
  return found == times.end() ? 0 : found->second;
}

std::string sizeText(int cells) { return std::to_string(cells) + "x" + std::to_string(cells); }

std::string numberText(double number) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g", number);
  return text;
}

class Table {
 public:
  void header(const char* title) {
    std::printf("\n%-44s %7s %12s %12s %6s %9s %11s  %s\n", title, "size", "time", "unavoidable", "ratio", "iter.",
                "thesis", "converged");
  }

  void add(const std::string& name, int size, const ContestResult& result, double unavoidable, double thesis) {
    Json row;
    row["area"] = "cloth";
    row["name"] = name;
    row["seconds"] = result.seconds;
    row["iterations"] = std::lround(result.iterations);
    row["unavoidable_seconds"] = unavoidable > 0 ? Json(unavoidable) : Json(nullptr);
    row["thesis_seconds"] = thesis > 0 ? Json(thesis) : Json(nullptr);
    row["size"] = size;
    row["measured"] = result.projections;
    row["converged"] = result.converged;
    row["overshoot"] = result.overshoot;
    rows_.push_back(row);
    std::printf("%-44s %7d %10.5f s ", name.c_str(), size, result.seconds);
    if (unavoidable > 0)
      std::printf("%10.5f s %6.2f", unavoidable, result.seconds / unavoidable);
    else
      std::printf("%12s %6s", "-", "-");
    std::printf(" %9.1f ", result.iterations);
    if (thesis > 0)
      std::printf("%9.3f s", thesis);
    else
      std::printf("%11s", "-");
    std::printf(
        "  %d of %d%s\n", result.converged, result.projections, result.converged < result.projections ? " *" : "");
    std::fflush(stdout);
  }

  const Json& rows() const { return rows_; }

 private:
  Json rows_ = Json::array();
};

void measureNewton(const SheetSize& size, Table& table) {
  cloth::ClothSimulation simulation(std::make_shared<const cloth::ClothProblem>(swingingSheet(size.cells, 0.01)),
                                    steppingOptions(SteppingScheme::implicitEuler));
  base::ExecutionContext context;
  ContestResult result;
  for (int step = 0; step < size.steps; ++step) {
    const cloth::StepRecord record = simulation.step(context);
    if (step < size.skipped) continue;
    ++result.projections;
    result.converged += record.termination == base::TerminationType::converged;
    result.seconds += record.newtonSeconds;
    result.iterations += record.newtonIterations;
  }
  result.seconds /= result.projections;
  result.iterations /= result.projections;
  table.add("cloth/newton/" + sizeText(size.cells), 3 * simulation.problem().model->nodeCount(), result, 0,
            size.thesis.newton);
}

void measureProjections(const SheetSize& size, double limit, Table& table, double& seconds) {
  const cloth::ClothProblem problem = swingingSheet(size.cells, limit);
  const std::string suffix = sizeText(size.cells) + "/limit-" + numberText(limit);
  std::vector<Contender> contenders = {
      {"cloth/project/" + suffix + "/warm"}, {"cloth/project/" + suffix + "/cold", "cone", false, 0, size.every}};
  const bool inTable = size.cells <= 60;
  if (inTable && limit == 0.01)
    for (const int count : {4, 8, 18})
      if (count != 8 || size.cells == 20)
        contenders.push_back(
            {"cloth/project/" + suffix + "/sampled-" + std::to_string(count), "cone", false, count, 2 * size.every});
  if (inTable) {
    // The few that are measured come from all of the motion; a budget keeps those within bounds that do not converge.
    const int projections = 2 * (size.steps - size.skipped), tries = size.cells <= 10 ? 5 : size.cells <= 20 ? 3 : 1;
    const int every = std::max(1, projections / (tries + 1));
    contenders.push_back({"cloth/gauss-seidel/" + suffix, "gauss_seidel", false, 0, every, tries + 1, 3});
    // Ipopt hears of the budget between iterations only, and those of larger sheets take longer than all of this.
    if (size.cells <= 20)
      contenders.push_back({"cloth/ipopt/" + suffix, "nonlinear_program", false, 0, every, tries + 1, 3});
  }
  const std::vector<ContestResult> results =
      runContest(problem, steppingOptions(SteppingScheme::stepAndReflect), size.steps, 2 * size.skipped, contenders);
  const double unavoidable = unavoidableSeconds(problem);
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const Contender& contender = contenders[i];
    const bool cone = contender.method == "cone";
    const auto& thesis = cone                                 ? size.thesis.cone
                         : contender.method == "gauss_seidel" ? size.thesis.gaussSeidel
                                                              : size.thesis.ipopt;
    table.add(contender.name, 3 * problem.model->nodeCount(), results[i],
              cone ? unavoidable * results[i].iterations : 0, timeOf(thesis, limit));
  }
  seconds = results[0].seconds;
}

void measureTightness(Table& table) {
  const int cells = 40, steps = 40, skipped = 20;
  for (const double limit : {0.2, 0.001}) {
    const cloth::ClothProblem problem = swingingSheet(cells, limit);
    const std::vector<Contender> contenders = {
        {"cloth/project/" + sizeText(cells) + "/limit-" + numberText(limit) + "/warm"}};
    const ContestResult result =
        runContest(problem, steppingOptions(SteppingScheme::stepAndReflect), steps, 2 * skipped, contenders)[0];
    table.add(
        contenders[0].name, 3 * problem.model->nodeCount(), result, unavoidableSeconds(problem) * result.iterations, 0);
  }
}

}  // namespace

Json measureCloth() {
  math::setThreadCount(1);
  Table table;
  std::printf(
      "Square sheets of 0.5 m swinging from two corners, step-and-reflect, 0.01 s, relative gap 1e-7, one thread;\n"
      "means of a projection (of a step: newton). *: not all converged, within 3 s.\n");
  table.header("name");
  for (const SheetSize& size : sizes())
    if (size.cells <= 100) measureNewton(size, table);
  for (const double limit : {0.01, 0.1}) {
    table.header(limit == 0.01 ? "limit 1 %" : "limit 10 %");
    double before = 0;
    int cellsBefore = 0;
    for (const SheetSize& size : sizes()) {
      if (limit == 0.1 && size.cells > 60) continue;
      double seconds = 0;
      measureProjections(size, limit, table, seconds);
      const double nodes = std::pow(size.cells + 1, 2), nodesBefore = std::pow(cellsBefore + 1, 2);
      if (cellsBefore > 0)
        std::printf("  from %s to %s: time grows as nodes^%.2f\n", sizeText(cellsBefore).c_str(),
                    sizeText(size.cells).c_str(), std::log(seconds / before) / std::log(nodes / nodesBefore));
      before = seconds;
      cellsBefore = size.cells;
    }
  }
  table.header("other limits");
  measureTightness(table);
  return table.rows();
}

}  // namespace pliant::bench
