#include "core/scene/parameter_table.hpp"

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/rod_wires.hpp"

namespace pliant::scene {

namespace {

constexpr double millimetresPerMetre = 1e3;

/// The point mass whose value stands at a pointer, or null.
const mechanics::PointMass* massAt(const mechanics::Model& model, const std::string& pointer) {
  for (std::size_t i = 0; i < model.pointMasses.size(); ++i)
    if (pointer == childPointer("/point_masses", i) + "/mass") return &model.pointMasses[i];
  return nullptr;
}

}  // namespace

std::string parameterTable(const mechanics::Model& model, const PartsRequest& request) {
  CsvWriter table;
  for (const char* column : {"name", "pointer", "value", "unit", "minimum", "maximum", "pieces", "ball diameter [mm]",
                             "cylinder diameter [mm]", "cylinder height [mm]"})
    table.add(column);
  table.endRow();
  for (const auto& parameter : model.parameters) {
    const mechanics::PointMass* mass = massAt(model, parameter->pointer());
    table.add(parameter->name()).add(parameter->pointer()).add(parameter->value(model));
    table.add(base::siUnit(parameter->dimension())).add(parameter->minimum(model)).add(parameter->maximum(model));
    if (mass) {
      const double section = mass->mass / (request.density * request.cylinderHeight);
      table.add(static_cast<long>(mass->nodes.size()));
      table.add(millimetresPerMetre * ballDiameter(mass->mass, request.density));
      table.add(millimetresPerMetre * std::sqrt(4 * section / std::numbers::pi));
      table.add(millimetresPerMetre * request.cylinderHeight);
    } else {
      for (int column = 0; column < 4; ++column) table.add("");
    }
    table.endRow();
  }
  return table.text();
}

int writeParameterTable(const mechanics::Model& model, const PartsRequest& request, const std::filesystem::path& file) {
  if (model.parameters.empty())
    throw base::InputError(file.string(), "This scene has no design parameters to write a table of.");
  writeTextFile(file, parameterTable(model, request));
  return static_cast<int>(model.parameters.size());
}

}  // namespace pliant::scene
