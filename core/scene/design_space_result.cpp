#include "core/scene/design_space_result.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/harmonic/design_constraint.hpp"
#include "core/harmonic/path_length.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/result_folder.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

using harmonic::MotionOrigin;
using harmonic::SampledDesign;
using mechanics::Matrix;

namespace {

constexpr int pathInstants = 64;

std::string_view motionOriginName(MotionOrigin origin) {
  switch (origin) {
    case MotionOrigin::followed: return "followed";
    case MotionOrigin::anew: return "anew";
    case MotionOrigin::none: break;
  }
  return "none";
}

bool hasMotion(const SampledDesign& design) { return design.origin != MotionOrigin::none; }

std::string withUnit(const std::string& name, const std::string& unit) {
  return name + (unit.empty() ? "" : " [" + unit + "]");
}

std::string designTable(const DesignSpaceResult& result) {
  CsvWriter csv;
  const mechanics::Model& model = *result.model;
  csv.add("design").add("motion").add("from").add("residual").add("on the front");
  for (const int index : result.parameters) {
    const auto& parameter = *model.parameters[static_cast<std::size_t>(index)];
    csv.add(withUnit(parameter.name(), base::siUnit(parameter.dimension())));
  }
  for (const auto& probe : model.probes)
    csv.add(probe.name + " path length [m]").add(probe.name + " maximum displacement [m]");
  csv.add("total mass [kg]").endRow();
  const std::vector<int> front = result.front();
  for (std::size_t i = 0; i < result.space.designs.size(); ++i) {
    const SampledDesign& design = result.space.designs[i];
    csv.add(static_cast<long>(i)).add(motionOriginName(design.origin));
    if (design.from >= 0)
      csv.add(design.from);
    else
      csv.add("");
    if (hasMotion(design))
      csv.add(design.residual);
    else
      csv.add("");
    csv.add(std::find(front.begin(), front.end(), static_cast<int>(i)) != front.end() ? 1 : 0);
    for (const double value : design.values) csv.add(value);
    for (std::size_t p = 0; p < model.probes.size(); ++p) {
      if (hasMotion(design))
        csv.add(design.amplitudes[p].pathLength).add(design.amplitudes[p].maximumDisplacement);
      else
        csv.add("").add("");
    }
    if (hasMotion(design))
      csv.add(DesignMeasure{DesignMeasure::Kind::totalMass, 0, false}.of(design));
    else
      csv.add("");
    csv.endRow();
  }
  return csv.text();
}

std::string pathTable(const DesignSpaceResult& result) {
  CsvWriter csv;
  const mechanics::Model& model = *result.model;
  csv.add("design").add("omega t [rad]");
  for (const auto& probe : model.probes)
    for (int axis = 0; axis < model.dimension; ++axis) csv.add(probe.name + " " + "xyz"[axis] + " [m]");
  csv.endRow();
  const math::HarmonicBasis instants(result.harmonics, std::max(pathInstants, 2 * result.harmonics + 1));
  for (std::size_t i = 0; i < result.space.designs.size(); ++i) {
    const SampledDesign& design = result.space.designs[i];
    if (!hasMotion(design)) continue;
    const harmonic::HarmonicBalanceProblem problem(design.model, math::HarmonicBasis(result.harmonics, result.samples));
    std::vector<Matrix> paths;
    for (const auto& probe : model.probes)
      paths.push_back(instants.synthesis() * harmonic::nodeCoefficients(problem, design.z, probe.node));
    for (int instant = 0; instant < instants.samples(); ++instant) {
      csv.add(static_cast<long>(i)).add(2 * std::numbers::pi * instant / instants.samples());
      for (const Matrix& path : paths)
        for (const double coordinate : path.row(instant)) csv.add(coordinate);
      csv.endRow();
    }
  }
  return csv.text();
}

}  // namespace

std::string DesignMeasure::name(const mechanics::Model& model) const {
  if (kind == Kind::totalMass) return "total mass";
  return model.probes[probe].name + (kind == Kind::pathLength ? " path length" : " maximum displacement");
}

std::string DesignMeasure::unit() const { return kind == Kind::totalMass ? "kg" : "m"; }

double DesignMeasure::of(const SampledDesign& design) const {
  if (kind != Kind::totalMass)
    return kind == Kind::pathLength ? design.amplitudes[probe].pathLength
                                    : design.amplitudes[probe].maximumDisplacement;
  return harmonic::totalMass(*design.model);
}

int DesignSpaceResult::foundCount() const {
  return static_cast<int>(std::count_if(space.designs.begin(), space.designs.end(), hasMotion));
}

std::vector<int> DesignSpaceResult::front() const {
  std::vector<int> found;
  for (std::size_t i = 0; i < space.designs.size(); ++i)
    if (hasMotion(space.designs[i])) found.push_back(static_cast<int>(i));
  Matrix points(static_cast<Eigen::Index>(found.size()), 2);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (int m = 0; m < 2; ++m) {
      const DesignMeasure& measure = measures[static_cast<std::size_t>(m)];
      const double value = measure.of(space.designs[static_cast<std::size_t>(found[static_cast<std::size_t>(i)])]);
      points(i, m) = measure.largestIsBest ? value : -value;
    }
  std::vector<int> front;
  for (const int i : harmonic::paretoFront(points)) front.push_back(found[static_cast<std::size_t>(i)]);
  if (!measures[0].largestIsBest) std::reverse(front.begin(), front.end());
  return front;
}

Json DesignSpaceResult::summary() const {
  Json json = summaryHead(*this);
  addFrequency(json, omega);
  const auto count = static_cast<int>(space.designs.size());
  json["design_count"] = count;
  json["found_count"] = foundCount();
  json["share_without_motion"] = count > 0 ? Json(static_cast<double>(count - foundCount()) / count) : Json();
  json["found_anew"] = std::count_if(space.designs.begin(), space.designs.end(),
                                     [](const auto& design) { return design.origin == MotionOrigin::anew; });
  double worst = 0;
  for (const SampledDesign& design : space.designs) worst = std::max(worst, design.residual);
  json["largest_residual"] = worst;
  Json list = Json::array();
  for (const DesignMeasure& measure : measures) {
    double smallest = std::numeric_limits<double>::infinity(), largest = -smallest;
    for (const SampledDesign& design : space.designs) {
      if (!hasMotion(design)) continue;
      smallest = std::min(smallest, measure.of(design));
      largest = std::max(largest, measure.of(design));
    }
    Json entry{{"name", measure.name(*model)}, {"unit", measure.unit()}, {"largest_is_best", measure.largestIsBest}};
    if (foundCount() > 0) {
      entry["smallest"] = smallest;
      entry["largest"] = largest;
      if (hasMotion(space.designs.front())) entry["of_the_scene"] = measure.of(space.designs.front());
    }
    list.push_back(entry);
  }
  json["measures"] = list;
  Json onFront = Json::array();
  for (const int i : front()) {
    const SampledDesign& design = space.designs[static_cast<std::size_t>(i)];
    Json values = Json::array();
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      const auto& parameter = *model->parameters[static_cast<std::size_t>(parameters[p])];
      values.push_back({{"name", parameter.name()},
                        {"value", design.values[static_cast<Eigen::Index>(p)]},
                        {"unit", base::siUnit(parameter.dimension())}});
    }
    onFront.push_back(
        {{"design", i}, {"measures", {measures[0].of(design), measures[1].of(design)}}, {"parameters", values}});
  }
  json["front"] = onFront;
  json["front_count"] = onFront.size();
  json["probes"] = Json::array();
  for (const auto& probe : model->probes) json["probes"].push_back(probe.name);
  json["dimension"] = model->dimension;
  json["harmonics"] = harmonics;
  json["samples"] = samples;
  json["units"] = {{"frequency", "rad/s"}, {"frequency_hz", "Hz"}, {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

void DesignSpaceResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  if (!space.designs.empty()) {
    folder.writeFile("designs.csv", designTable(*this));
    folder.writeFile("paths.csv", pathTable(*this));
  }
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

}  // namespace pliant::scene
