#pragma once

#include <filesystem>
#include <string>

#include "core/mechanics/model.hpp"
#include "core/scene/parts_request.hpp"

namespace pliant::scene {

/// A row for each design parameter: name, JSON pointer, value, unit and bounds. For point masses also how many pieces
/// there are, the diameter of a ball of that mass (request.density), and the diameter and height of a cylinder
/// (request.cylinderHeight).
std::string parameterTable(const mechanics::Model& model, const PartsRequest& request);

/// Writes it, and returns the number of rows. Throws base::InputError if the model has no parameters, or for the
/// file.
int writeParameterTable(const mechanics::Model& model, const PartsRequest& request, const std::filesystem::path& file);

}  // namespace pliant::scene
