#include "core/scene/result_folder.hpp"

#include <unistd.h>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

namespace fs = std::filesystem;
using base::InputError;

namespace {

fs::path sibling(const fs::path& directory, const char* suffix) {
  return directory.parent_path() / ("." + directory.filename().string() + suffix + std::to_string(::getpid()));
}

}  // namespace

ResultFolder::ResultFolder(fs::path directory) : directory_(fs::absolute(directory).lexically_normal()) {
  if (directory_.filename().empty()) directory_ = directory_.parent_path();
  std::error_code error;
  const auto status = fs::status(directory_, error);
  if (fs::exists(status) && !fs::is_directory(status))
    throw InputError(directory_.string(), "Results need a folder, but this is a file.");
  if (fs::exists(status) && !fs::is_empty(directory_, error) && !fs::exists(directory_ / "summary.json"))
    throw InputError(directory_.string(), "This folder exists and holds no result; it is not replaced.");
  temporary_ = sibling(directory_, ".writing-");
  fs::remove_all(temporary_, error);
  fs::create_directories(temporary_, error);
  if (error) throw InputError(directory_.string(), "The folder cannot be made: " + error.message() + ".");
}

ResultFolder::~ResultFolder() {
  std::error_code error;
  fs::remove_all(temporary_, error);
}

void ResultFolder::writeFile(const std::string& name, std::string_view text) { writeTextFile(path(name), text); }

void ResultFolder::commit() {
  const fs::path old = sibling(directory_, ".replaced-");
  std::error_code error;
  const bool replaces = fs::exists(directory_);
  if (replaces) fs::rename(directory_, old, error);
  if (!error) fs::rename(temporary_, directory_, error);
  if (error) throw InputError(directory_.string(), "The folder cannot be written: " + error.message() + ".");
  fs::remove_all(old, error);
}

}  // namespace pliant::scene
