#pragma once

#include <filesystem>

#include "core/base/error.hpp"
#include "core/scene/interlock_result.hpp"

namespace pliant::scene {

base::TerminationType limitTerminationNamed(std::string_view name);

/// Fills in what all results of interlocking materials have from summary.json, which it returns; the cell is that of
/// the scene. Throws base::InputError if it is none of a study of this type of this scene.
Json readInterlockHead(const Scene& scene, const std::filesystem::path& directory, std::string_view type,
                       InterlockResult& result);

/// Calls `read(result)` with a new result; keys that summary.json lacks become one sentence.
template <class AnyResult, class Read>
std::shared_ptr<AnyResult> readInterlockResult(const std::filesystem::path& directory, const Read& read) {
  auto result = std::make_shared<AnyResult>();
  try {
    read(*result);
  } catch (const Json::exception&) {
    throw base::InputError(
        (directory / "summary.json").string(), "This summary lacks what such a result has; run its study again.");
  }
  return result;
}

}  // namespace pliant::scene
