#include "core/scene/scene.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/migration.hpp"
#include "core/scene/normalize.hpp"

namespace pliant::scene {

using base::InputError;
using base::ParameterSpec;
using base::ValueKind;

namespace {

/// The tokens of a JSON pointer, unescaped. Throws base::InputError.
std::vector<std::string> tokensOf(const std::string& pointer) {
  try {
    Json::json_pointer rest(pointer);
    std::vector<std::string> tokens;
    for (; !rest.empty(); rest.pop_back()) tokens.push_back(rest.back());
    std::reverse(tokens.begin(), tokens.end());
    return tokens;
  } catch (const Json::parse_error&) {
    throw InputError("", quote(pointer) + " is no JSON pointer; it starts with \"/\".");
  }
}

/// The index that `token` gives in a list of `count` entries, or -1.
long indexOf(const std::string& token, std::size_t count) {
  const bool digits = !token.empty() && token.size() < 10 &&
                      std::all_of(token.begin(), token.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
  const long index = digits ? std::stol(token) : -1;
  return index < static_cast<long>(count) ? index : -1;
}

}  // namespace

Scene Scene::load(const std::filesystem::path& file) {
  const std::string text = readTextFile(file);
  return parse(text, std::filesystem::absolute(file).parent_path(), file.string());
}

Scene Scene::parse(std::string_view text, const std::filesystem::path& directory, const std::string& name) {
  Scene scene;
  scene.directory_ = directory;
  scene.name_ = name;
  try {
    scene.json_ = std::make_shared<const Json>(migrate(parseJson(text), migrationSteps(), schemaVersion));
    scene.normalized_ = std::make_shared<const Json>(normalizeScene(*scene.json_));
  } catch (const InputError& error) {
    throw error.inside(name);
  }
  return scene;
}

Scene Scene::withValue(const std::string& pointer, const Json& value) const {
  try {
    const std::vector<std::string> tokens = tokensOf(pointer);
    Json edited = *json_;
    Json* place = &edited;
    for (const std::string& token : tokens) {
      const long index = place->is_array() ? indexOf(token, place->size()) : -1;
      if (index >= 0)
        place = &(*place)[static_cast<std::size_t>(index)];
      else if (place->is_object() || place->is_null())
        place = &(*place)[token];
      else
        throw InputError(pointer, "The scene has no such value to change.");
    }
    *place = value;
    Scene scene = *this;
    scene.normalized_ = std::make_shared<const Json>(normalizeScene(edited));
    scene.json_ = std::make_shared<const Json>(std::move(edited));
    return scene;
  } catch (const InputError& error) {
    throw error.inside(name_);
  }
}

Scene Scene::withNumbers(const std::vector<std::string>& pointers, const std::vector<double>& values) const {
  try {
    Json edited = *normalized_;
    for (std::size_t i = 0; i < pointers.size(); ++i) {
      checkNumber(*specAt(*this, pointers[i]), values[i], pointers[i]);
      edited.at(Json::json_pointer(pointers[i])) = values[i];
    }
    checkScene(edited);
    Scene scene = *this;
    scene.json_ = scene.normalized_ = std::make_shared<const Json>(std::move(edited));
    return scene;
  } catch (const InputError& error) {
    throw error.inside(name_);
  }
}

void Scene::save(const std::filesystem::path& file) const { writeTextFile(file, formatJson(*json_)); }

const ParameterSpec* specAt(const Scene& scene, const std::string& pointer) {
  const ParameterSpec* spec = &sceneSpec();
  const Json* value = &scene.normalized();
  for (const std::string& token : tokensOf(pointer)) {
    if (spec->kind == ValueKind::variant) {
      if (!value) return nullptr;
      const auto item = std::find_if(
          spec->items.begin(), spec->items.end(), [&](const ParameterSpec& s) { return s.key == (*value)["type"]; });
      spec = &*item;
    }
    if (spec->kind == ValueKind::list) {
      const long index = value ? indexOf(token, value->size()) : -1;
      if (index < 0) return nullptr;
      spec = &spec->items[std::min<std::size_t>(static_cast<std::size_t>(index), spec->items.size() - 1)];
      value = &(*value)[static_cast<std::size_t>(index)];
    } else if (spec->kind == ValueKind::object) {
      const auto field = std::find_if(
          spec->fields.begin(), spec->fields.end(), [&](const ParameterSpec& s) { return s.key == token; });
      if (field == spec->fields.end()) return nullptr;
      spec = &*field;
      value = value && value->contains(token) ? &(*value)[token] : nullptr;
    } else {
      return nullptr;
    }
  }
  if (spec->kind == ValueKind::variant && value)
    for (const ParameterSpec& item : spec->items)
      if (item.key == (*value)["type"]) return &item;
  return spec;
}

}  // namespace pliant::scene
