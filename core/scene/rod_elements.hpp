#pragma once

#include "core/base/parameter_spec.hpp"
#include "core/scene/element_builders.hpp"

namespace pliant::scene {

/// The elements "rod" and "flat_rod" of the file format, given the keys "geometry" and "material" that all elements
/// have.
std::vector<base::ParameterSpec> rodSpecs(const base::ParameterSpec& geometry, const base::ParameterSpec& material);

void addRods(const ElementContext& context);

}  // namespace pliant::scene
