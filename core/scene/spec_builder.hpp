#pragma once

#include <string>
#include <vector>

#include "core/base/parameter_spec.hpp"

/// Short forms that keep the declaration of the file format readable.
namespace pliant::scene::spec {

using base::Dimension;
using base::Json;
using base::ParameterSpec;

ParameterSpec number(std::string key, std::string symbol, std::string description, Dimension dimension);
ParameterSpec integer(std::string key, std::string symbol, std::string description, int minimum, int maximum);
ParameterSpec boolean(std::string key, std::string description);
ParameterSpec text(std::string key, std::string description);
ParameterSpec name();
ParameterSpec reference(std::string key, std::string description, std::string target);
ParameterSpec choice(std::string key, std::string description, std::vector<std::string> choices);
ParameterSpec object(std::string key, std::string description, std::vector<ParameterSpec> fields);
ParameterSpec variant(std::string key, std::string description, std::vector<ParameterSpec> items);
ParameterSpec list(std::string key, std::string description, ParameterSpec item, int minimumCount, int maximumCount);
/// One entry for each dimension of the scene.
ParameterSpec vector(std::string key, std::string description, Dimension dimension);
/// A list of nodes of one geometry, chosen by index, group, nearest point, or box.
ParameterSpec selection(std::string key, std::string description);
/// Terms of Σ amplitude cos(order τ + phase).
ParameterSpec signal(std::string description, Dimension amplitude);

ParameterSpec positive(ParameterSpec spec);
ParameterSpec notNegative(ParameterSpec spec);
ParameterSpec within(ParameterSpec spec, double minimum, double maximum);
ParameterSpec withDefault(ParameterSpec spec, Json value);
ParameterSpec optional(ParameterSpec spec);

}  // namespace pliant::scene::spec
