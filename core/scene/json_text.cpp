#include "core/scene/json_text.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/pending_file.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

constexpr std::size_t deepest = 64;
constexpr std::uintmax_t largestFile = 256u << 20;

/// Follows the parser, so that an error can say where in the document it happened.
class Position {
 public:
  bool handle(Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    switch (event) {
      case Event::object_start:
      case Event::array_start:
        levels_.push_back({event == Event::array_start, 0, "", {}});
        if (levels_.size() > deepest) throw InputError(pointer(), "The scene is nested deeper than 64 levels.");
        break;
      case Event::key: {
        Level& level = levels_.back();
        level.key = parsed.get_ref<const std::string&>();
        if (!level.keys.insert(level.key).second)
          throw InputError(pointer(), "The key " + quote(level.key) + " stands twice in one object.");
        break;
      }
      case Event::value: advance(); break;
      case Event::object_end:
      case Event::array_end:
        levels_.pop_back();
        advance();
        break;
    }
    return true;
  }

  std::string pointer() const {
    std::string result;
    for (const Level& level : levels_) {
      if (!level.isList && level.key.empty()) break;
      result = level.isList ? childPointer(result, level.index) : childPointer(result, level.key);
    }
    return result;
  }

 private:
  struct Level {
    bool isList;
    std::size_t index;
    std::string key;
    std::set<std::string> keys;
  };

  void advance() {
    if (levels_.empty()) return;
    Level& level = levels_.back();
    if (level.isList)
      ++level.index;
    else
      level.key.clear();
  }

  std::vector<Level> levels_;
};

std::string lineAndColumn(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - start + 1);
}

bool fitsOnLine(const Json& json, std::size_t width, std::string& line) {
  if (json.is_array() && json.size() > width) return false;
  line.clear();
  std::function<bool(const Json&)> write = [&](const Json& value) {
    if (!value.is_structured()) {
      line += value.dump(-1, ' ', false, Json::error_handler_t::replace);
      return line.size() <= width;
    }
    const bool isObject = value.is_object();
    line += isObject ? '{' : '[';
    bool first = true;
    for (const auto& [key, item] : value.items()) {
      if (!first) line += ", ";
      first = false;
      if (isObject) line += Json(key).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
      if (!write(item)) return false;
    }
    line += isObject ? '}' : ']';
    return line.size() <= width;
  };
  return write(json);
}

void format(const Json& json, std::size_t indent, std::size_t used, std::string& out) {
  constexpr std::size_t width = 110;
  std::string line;
  if (fitsOnLine(json, width > indent + used ? width - indent - used : 1, line) || !json.is_structured() ||
      json.empty()) {
    out += line.empty() ? json.dump(-1, ' ', false, Json::error_handler_t::replace) : line;
    return;
  }
  const std::string inner(indent + 2, ' ');
  out += json.is_object() ? "{\n" : "[\n";
  bool first = true;
  for (const auto& [key, item] : json.items()) {
    if (!first) out += ",\n";
    first = false;
    out += inner;
    std::string label;
    if (json.is_object()) label = Json(key).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    out += label;
    format(item, indent + 2, label.size(), out);
  }
  out += '\n' + std::string(indent, ' ') + (json.is_object() ? '}' : ']');
}

}  // namespace

Json parseJson(std::string_view text) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) throw InputError("", "The scene is empty.");
  Position position;
  try {
    return Json::parse(
        text, [&](int, Json::parse_event_t event, Json& parsed) { return position.handle(event, parsed); });
  } catch (const Json::parse_error& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing ... - REASON; last
    // read: ..."
    std::string reason = error.what();
    const std::size_t dash = reason.find(" - ");
    reason = dash == std::string::npos ? "unreadable text" : reason.substr(dash + 3);
    reason = reason.substr(0, reason.find("; last read"));
    if (const std::size_t colon = reason.find("; expected"); colon != std::string::npos) reason.resize(colon);
    std::replace_if(
        reason.begin(), reason.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
    throw InputError(position.pointer(), "This is no JSON at " +
                                             lineAndColumn(text, error.byte == 0 ? 0 : error.byte - 1) + ": " +
                                             reason.substr(0, 120) + ".");
  } catch (const Json::out_of_range&) {
    throw InputError(position.pointer(), "The number is too large: numbers must be finite.");
  }
}

std::string formatJson(const Json& json) {
  std::string text;
  format(json, 0, 0, text);
  return text + "\n";
}

std::string quote(std::string_view text) {
  constexpr std::size_t longest = 80;
  const std::string shown = text.size() > longest ? std::string(text.substr(0, longest)) + "..." : std::string(text);
  return Json(shown).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string describe(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list";
  if (value.is_string()) return "the text " + quote(value.get_ref<const std::string&>());
  if (value.is_number()) return "the number " + value.dump();
  return value.dump();
}

std::string childPointer(const std::string& parent, std::string_view token) {
  std::string result = parent + "/";
  for (const char c : token) {
    if (c == '~')
      result += "~0";
    else if (c == '/')
      result += "~1";
    else
      result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  return result;
}

std::string childPointer(const std::string& parent, std::size_t index) { return parent + "/" + std::to_string(index); }

std::string readTextFile(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(file.string(), "There is no such file.");
  if (std::filesystem::is_directory(status)) throw InputError(file.string(), "This is a folder, not a file.");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), "The file cannot be opened.");
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(file, error) > largestFile)
    throw InputError(file.string(), "The file is larger than 256 MiB.");
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad()) throw InputError(file.string(), "The file cannot be read.");
  return std::move(text).str();
}

void writeTextFile(const std::filesystem::path& file, std::string_view text) { base::writeFile(file, text); }

}  // namespace pliant::scene
