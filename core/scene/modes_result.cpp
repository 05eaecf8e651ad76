#include "core/scene/modes_result.hpp"

#include "core/geometry/surface_mesh.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/result_folder.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

namespace {

std::string modeTable(const ModesResult& result) {
  const mechanics::Model& model = result.problem->model();
  CsvWriter csv;
  csv.add("node").add("axis").add("equilibrium [m]");
  for (std::size_t i = 1; i <= result.modes.modes.size(); ++i) csv.add("mode " + std::to_string(i) + " [1/sqrt(kg)]");
  csv.endRow();
  for (int coordinate = 0; coordinate < result.modes.equilibrium.size(); ++coordinate) {
    const int scalar = coordinate - model.nodeCount() * model.dimension;
    if (scalar < 0)
      csv.add(coordinate / model.dimension).add(std::string(1, "xyz"[coordinate % model.dimension]));
    else
      csv.add("").add("scalar " + std::to_string(scalar));
    csv.add(result.modes.equilibrium[coordinate]);
    const int free = model.dofs.freeIndex[static_cast<std::size_t>(coordinate)];
    for (const harmonic::LinearMode& mode : result.modes.modes) csv.add(free < 0 ? 0.0 : mode.shape[free]);
    csv.endRow();
  }
  return csv.text();
}

}  // namespace

mechanics::Vector ModesResult::motion(std::size_t i, double swing) const {
  const mechanics::Vector& shape = modes.modes[i].shape;
  const int width = problem->basis().size();
  const double scale = swing / shape.cwiseAbs().maxCoeff();
  mechanics::Vector z = problem->constantCoefficients(modes.equilibrium);
  for (Eigen::Index free = 0; free < shape.size(); ++free) z[free * width + 1] = scale * shape[free];
  return z;
}

Json ModesResult::summary() const {
  const mechanics::Model& model = problem->model();
  Json json = summaryHead(*this);
  Json list = Json::array();
  double residual = 0;
  for (const harmonic::LinearMode& mode : modes.modes) {
    Json entry;
    addFrequency(entry, mode.omega);
    entry["damping_ratio"] = mode.dampingRatio;
    entry["residual"] = mode.residual;
    Json probes = Json::array();
    for (const mechanics::Probe& probe : model.probes) {
      Json shape = Json::array();
      for (int axis = 0; axis < model.dimension; ++axis) {
        const int free = model.dofs.freeIndex[probe.node * model.dimension + axis];
        shape.push_back(free < 0 ? 0.0 : mode.shape[free]);
      }
      probes.push_back({{"name", probe.name}, {"shape", shape}});
    }
    entry["probes"] = probes;
    residual = std::max(residual, mode.residual);
    list.push_back(entry);
  }
  json["mode_count"] = list.size();
  json["modes"] = list;
  json["residual"] = residual;
  json["nodes"] = model.nodeCount();
  json["free_coordinates"] = model.dofs.freeCount();
  json["parameters"] = parameterValues(model);
  json["units"] = {{"frequency", "rad/s"},
                   {"frequency_hz", "Hz"},
                   {"damping_ratio", "of critical damping"},
                   {"residual", "bound of the relative error of 1/frequency^2"},
                   {"shape", "1/sqrt(kg), normalised by the mass matrix"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

void ModesResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  folder.writeFile("modes.csv", modeTable(*this));
  if (modes.equilibrium.size() > 0)
    if (const geometry::SurfaceMesh mesh = surfaceAt(problem->model(), modes.equilibrium); !mesh.triangles.empty())
      geometry::writeMesh(mesh, folder.path("mesh.ply"));
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

}  // namespace pliant::scene
