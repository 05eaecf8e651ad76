#pragma once

#include <QString>

#include "core/base/parameter_spec.hpp"

namespace pliant::panels {

using base::Json;
using base::ParameterSpec;

/// "Young modulus" from "young_modulus".
QString humanName(const std::string& key);

/// How a value is shown: as it was written if that was with a unit ("40 deg"), else with four digits and a fitting
/// prefix. Short lists of numbers stand in one line. `normalized` is the value in SI, `written` what the file says (may
/// be null).
QString displayText(const Json& normalized, const Json& written, const ParameterSpec& spec);

/// The same to begin editing with, every digit kept.
QString editText(const Json& normalized, const Json& written, const ParameterSpec& spec);

/// What to put into the scene for a text that was typed. A bare number takes the unit of `shown`, the text it replaces.
/// Numbers that are none stay text, for the scene to refuse with its own sentence.
Json parseText(const QString& typed, const QString& shown, const ParameterSpec& spec);

/// A list of at most four numbers, which is shown and edited in one line.
bool isShortVector(const Json& value, const ParameterSpec& spec);

/// One or more lines: description, symbol, range, default.
QString explanation(const ParameterSpec& spec);

/// What a list entry is called: its name, or its type, or its number.
QString entryName(const Json& entry, int index);

/// A parameter value near `value` that is short to write (four digits), with its unit, and the SI number it stands for.
struct RoundedQuantity {
  std::string text;
  double value = 0;
};
RoundedQuantity rounded(double value, const base::Dimension& dimension);

}  // namespace pliant::panels
