#pragma once

#include <cctype>
#include <string>

#include "core/base/error.hpp"

namespace pliant::scene {

/// With a capital letter and a full stop.
inline std::string asSentence(std::string text) {
  if (text.empty()) return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (text.back() != '.') text += '.';
  return text;
}

/// Calls `build`; an InputError without a location gets `pointer` as its location.
template <class Build>
decltype(auto) locate(const std::string& pointer, const Build& build) {
  try {
    return build();
  } catch (const base::InputError& error) {
    if (!error.location().empty()) throw;
    throw base::InputError(pointer, asSentence(error.problem()));
  }
}

}  // namespace pliant::scene
