#pragma once

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

using base::Json;

/// The scene with every value in SI as a number, every default filled in, references resolved where they may be left
/// out, and "type" always present; keys in the order of the spec. Throws base::InputError with a JSON pointer as
/// location at the first thing that the format does not allow.
Json normalizeScene(const Json& scene);

/// A finite number within the bounds of `spec`. Throws base::InputError with `pointer` as location.
void checkNumber(const base::ParameterSpec& spec, double value, const std::string& pointer);

/// The rules that concern several keys together (bounds of masses, samples for harmonics, ...), for a normalised scene;
/// also fills in defaults that follow from other values. Throws base::InputError.
void checkScene(Json& normalized);

}  // namespace pliant::scene
