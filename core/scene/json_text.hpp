#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

using base::Json;

/// Reads one JSON value. Throws base::InputError with the pointer of the place that was being read as location, and
/// line and column in the sentence: syntax errors, numbers out of range, keys that stand twice in one object, more than
/// 64 levels.
Json parseJson(std::string_view text);

/// Short objects and lists on one line, the rest indented by two spaces; ends with a newline.
std::string formatJson(const Json& json);

/// `text` in double quotes on one line, for error messages; cut if long.
std::string quote(std::string_view text);

/// What kind of value this is, with its text if short: `the number 3`, `an object`.
std::string describe(const Json& value);

/// The child pointer `parent`/`token` (escaped as RFC 6901 asks).
std::string childPointer(const std::string& parent, std::string_view token);
std::string childPointer(const std::string& parent, std::size_t index);

/// The contents of a file. Throws base::InputError with the file's name as location.
std::string readTextFile(const std::filesystem::path& file);

/// Writes a temporary file beside `file` and renames it. Throws base::InputError with the file's name as location.
void writeTextFile(const std::filesystem::path& file, std::string_view text);

}  // namespace pliant::scene
