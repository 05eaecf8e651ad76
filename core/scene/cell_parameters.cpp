#include "core/scene/cell_parameters.hpp"

#include <cmath>
#include <stdexcept>

#include "core/math/parallel.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/unchecked_cell.hpp"

namespace pliant::scene {

namespace {

constexpr double relativeStep = 0.01;

void collectNumbers(const Scene& scene, const Json& value, const std::string& entry, const std::string& name,
                    std::vector<CellParameter>& found) {
  if (value.is_object()) {
    for (const auto& [key, child] : value.items())
      collectNumbers(scene, child, entry, name.empty() ? key : name + "/" + key, found);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      collectNumbers(scene, value[i], entry, name + "/" + std::to_string(i), found);
  } else if (value.is_number()) {
    const base::ParameterSpec* spec = specAt(scene, entry + "/" + name);
    if (!spec || spec->kind != base::ValueKind::number) return;
    const double number = value.get<double>();
    // A length that is 0 has no scale of its own.
    const double size = number != 0 ? std::abs(number) : spec->dimension == base::dimensions::length ? 1e-3 : 1.0;
    found.push_back({name, spec->dimension, number, spec->minimum, spec->maximum, relativeStep * size});
  }
}

}  // namespace

std::size_t cellIndex(const Scene& scene, const std::string& name) {
  const Json& cells = scene.normalized()["interlocking_cells"];
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i]["name"] == name) return i;
  throw std::out_of_range("no such interlocking cell");
}

std::vector<CellParameter> cellParameters(const Scene& scene, std::size_t index) {
  std::vector<CellParameter> found;
  const std::string pointer = childPointer("/interlocking_cells", index);
  collectNumbers(scene, scene.normalized()["interlocking_cells"][index], pointer, "", found);
  return found;
}

interlock::CellFunction cellFunction(const Scene& scene, std::size_t index,
                                     const std::vector<CellParameter>& parameters) {
  std::vector<Json::json_pointer> places;
  for (const CellParameter& parameter : parameters) places.emplace_back("/" + parameter.name);
  return [entry = scene.normalized()["interlocking_cells"][index], places, directory = scene.directory(),
          pointer = childPointer("/interlocking_cells", index)](const Eigen::VectorXd& values) {
    Json changed = entry;
    for (std::size_t i = 0; i < places.size(); ++i) changed[places[i]] = values[static_cast<Eigen::Index>(i)];
    return uncheckedCell(changed, pointer, directory);
  };
}

std::vector<std::optional<interlock::CellRate>> cellRates(const interlock::CellFunction& build,
                                                          const std::vector<CellParameter>& parameters,
                                                          const Eigen::VectorXd& values) {
  std::vector<std::optional<interlock::CellRate>> rates(parameters.size());
  math::parallelFor(static_cast<int>(parameters.size()), [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    rates[index] = interlock::rateOf(build, values, i, parameters[index].step);
  });
  return rates;
}

Eigen::VectorXd valuesOf(const std::vector<CellParameter>& parameters) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) values[static_cast<Eigen::Index>(i)] = parameters[i].value;
  return values;
}

}  // namespace pliant::scene
