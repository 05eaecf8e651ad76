#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/units.hpp"

namespace pliant::base {

/// JSON that keeps the order in which a person wrote the keys.
using Json = nlohmann::ordered_json;

enum class ValueKind {
  number,   ///< a finite number, or a string with a unit
  integer,
  boolean,
  text,
  choice,   ///< one of `choices`
  path,     ///< a file, relative to the scene
  list,     ///< `items.front()` describes each entry
  object,   ///< `fields` describe the keys
  variant,  ///< an object whose key "type" chooses one of `items` (each an object whose `key` is the type's name)
};

/// One key of a scene, declared once: the file format, its JSON Schema, the property panel, tooltips, the command line
/// and the documentation are all made from it.
struct ParameterSpec {
  std::string key;
  std::string symbol;       ///< as in the literature, such as "ζ"; may be empty
  std::string description;  ///< one sentence
  ValueKind kind = ValueKind::number;
  Dimension dimension{};
  Json defaultValue;  ///< null: the key is required (unless `optional`)
  bool optional = false;  ///< may be absent without a default
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusiveMinimum = false;
  int minimumCount = 0;                                ///< list: smallest length
  int maximumCount = std::numeric_limits<int>::max();  ///< list: largest length
  std::vector<std::string> choices;
  std::vector<ParameterSpec> fields;
  std::vector<ParameterSpec> items;

  bool required() const { return defaultValue.is_null() && !optional; }
};

}  // namespace pliant::base
