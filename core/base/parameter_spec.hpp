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
  number,  ///< a finite number, or a string with a unit
  integer,
  boolean,
  text,
  name,       ///< a text that is unique in its list and can name a folder: letters, digits, space, "-", "_", "."
  reference,  ///< the name of an entry of the scene's list `target`; if optional, the only entry where there is one
  choice,     ///< one of `choices`
  path,       ///< a file, relative to the scene
  list,       ///< `items[i]` describes entry i, the last item all further entries
  object,     ///< `fields` describe the keys
  variant,    ///< an object whose key "type" chooses one of `items` (each an object whose `key` is the type's name);
              ///< "type" may be left out where there is one item, or for `defaultItem`
};

/// One key of a scene, declared once: the file format, its JSON Schema, the property panel, tooltips, the command line
/// and the documentation are all made from it.
struct ParameterSpec {
  std::string key;
  std::string symbol;       ///< as in the literature, such as "ζ"; may be empty
  std::string description;  ///< one sentence
  ValueKind kind = ValueKind::number;
  Dimension dimension{};
  Json defaultValue;      ///< null: the key is required (unless `optional`)
  bool optional = false;  ///< may be absent without a default
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusiveMinimum = false;
  int minimumCount = 0;                                ///< list: smallest length
  int maximumCount = std::numeric_limits<int>::max();  ///< list: largest length
  bool spatial = false;  ///< list: as many entries as the scene has dimensions; a longer default is cut
  std::vector<std::string> choices;
  std::string target;                   ///< reference: key of the list whose entries are named
  std::vector<std::string> exactlyOne;  ///< object: of these keys exactly one must be there
  std::string defaultItem;              ///< variant: key of the item that is meant where "type" is left out
  std::vector<ParameterSpec> fields;
  std::vector<ParameterSpec> items;

  /// Variant: the item that is meant where "type" is left out, or null.
  const ParameterSpec* itemWithoutType() const {
    for (const ParameterSpec& item : items)
      if (items.size() == 1 || item.key == defaultItem) return &item;
    return nullptr;
  }

  bool required() const { return defaultValue.is_null() && !optional; }
};

}  // namespace pliant::base
