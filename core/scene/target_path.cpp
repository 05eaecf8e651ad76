#include "core/scene/target_path.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/harmonic/closed_spline.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;
using mechanics::Matrix;

namespace {

constexpr int placesPerPiece = 32;  // of a spline: far more than any motion's harmonics need

Matrix vectorsOf(const Json& list, int dimension) {
  Matrix points(dimension, static_cast<Eigen::Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i)
    for (int axis = 0; axis < dimension; ++axis)
      points(axis, static_cast<Eigen::Index>(i)) = list[i][static_cast<std::size_t>(axis)];
  return points;
}

}  // namespace

Matrix targetControlPoints(const Json& entry, int dimension) {
  return entry.contains("spline") ? vectorsOf(entry["spline"], dimension) : Matrix(dimension, 0);
}

Matrix targetPlaces(const Scene& scene, const Json& entry, int dimension) {
  if (entry.contains("file")) return placesOfTable(scene.directory() / entry["file"].get<std::string>(), dimension);
  if (entry.contains("spline")) return harmonic::closedSpline(targetControlPoints(entry, dimension), placesPerPiece);
  return vectorsOf(entry["points"], dimension);
}

Matrix placesOfTable(const std::filesystem::path& file, int dimension) {
  const CsvTable table(file);
  if (table.size() < 3) throw InputError(file.string(), "A path needs at least 3 points.");
  Matrix points(dimension, static_cast<Eigen::Index>(table.size()));
  for (std::size_t i = 0; i < table.size(); ++i)
    for (int axis = 0; axis < dimension; ++axis)
      points(axis, static_cast<Eigen::Index>(i)) = table.number(i, std::string(1, "xyz"[axis]) + " [m]");
  return points;
}

std::vector<TargetPath> targetPaths(const Scene& scene, const mechanics::Model& model) {
  std::vector<TargetPath> list;
  const Json& studies = scene.normalized().at("studies");
  for (std::size_t s = 0; s < studies.size(); ++s) {
    if (studies[s]["type"] != "design") continue;
    const Json& objectives = studies[s]["objectives"];
    for (std::size_t o = 0; o < objectives.size(); ++o) {
      if (objectives[o]["type"] != "path") continue;
      const std::string place = childPointer(childPointer("/studies", s) + "/objectives", o) + "/paths";
      for (std::size_t p = 0; p < objectives[o]["paths"].size(); ++p) {
        const Json& entry = objectives[o]["paths"][p];
        const auto probe = std::find_if(model.probes.begin(), model.probes.end(), [&](const mechanics::Probe& each) {
          return each.name == entry["probe"].get_ref<const std::string&>();
        });
        if (probe == model.probes.end()) continue;
        try {
          list.push_back({studies[s]["name"], childPointer(place, p), probe->name, probe->node,
                          objectives[o]["match_place"], studies[s]["harmonics"],
                          targetPlaces(scene, entry, model.dimension), targetControlPoints(entry, model.dimension)});
        } catch (const InputError&) {
          continue;
        }
      }
    }
  }
  return list;
}

}  // namespace pliant::scene
