#pragma once

#include <string>

#include "core/base/error.hpp"

namespace pliant::scene {

/// Calls `build`; an InputError without a location gets `pointer` as its location.
template <class Build>
decltype(auto) locate(const std::string& pointer, const Build& build) {
  try {
    return build();
  } catch (const base::InputError& error) {
    if (!error.location().empty()) throw;
    throw base::InputError(pointer, error.problem());
  }
}

}  // namespace pliant::scene
