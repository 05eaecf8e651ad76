#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

using base::Json;

/// The newest `schema_version`.
inline constexpr int schemaVersion = 1;

/// A scene file in memory: as the person wrote it (units and key order kept), migrated to the newest version, and
/// valid. A value: an edit makes a new scene.
class Scene {
 public:
  /// Reads, migrates and validates. Throws base::InputError with `FILE: POINTER` as location.
  static Scene load(const std::filesystem::path& file);
  /// The same for text; relative paths count from `directory`, errors name `name`.
  static Scene parse(std::string_view text, const std::filesystem::path& directory, const std::string& name);

  const Json& json() const { return *json_; }
  /// Every value in SI as a number, every default filled in, "type" always present.
  const Json& normalized() const { return *normalized_; }
  const std::filesystem::path& directory() const { return directory_; }
  const std::string& name() const { return name_; }

  /// A copy with the value at `pointer` replaced (validated; throws base::InputError and changes nothing).
  Scene withValue(const std::string& pointer, const Json& value) const;
  /// A copy with other numbers [SI] in places of `normalized()` that hold numbers, checked like any; its `json()` is
  /// normalised as well. Costs a copy of the values, so it serves where many scenes differ in numbers alone.
  Scene withNumbers(const std::vector<std::string>& pointers, const std::vector<double>& values) const;

  /// Writes `json()` atomically (a temporary file that is renamed).
  void save(const std::filesystem::path& file) const;

 private:
  std::shared_ptr<const Json> json_;
  std::shared_ptr<const Json> normalized_;
  std::filesystem::path directory_;
  std::string name_;
};

/// The one declaration of the file format: an object spec whose fields are the keys of a scene.
const base::ParameterSpec& sceneSpec();

/// The spec of the value at `pointer` of this scene (variants resolved by "type"), or null.
const base::ParameterSpec* specAt(const Scene& scene, const std::string& pointer);

/// JSON Schema (2020-12) made from `sceneSpec()`.
Json jsonSchema();

}  // namespace pliant::scene
