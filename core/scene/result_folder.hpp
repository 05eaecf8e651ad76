#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pliant::scene {

/// A result's folder in the making: files are written beside it and take its place all at once by commit(). Whatever
/// ends before leaves what was there untouched.
class ResultFolder {
 public:
  /// Throws base::InputError with the folder as location if it cannot be written, or if `directory` exists and is
  /// neither empty nor a result (without summary.json).
  explicit ResultFolder(std::filesystem::path directory);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  void writeFile(const std::string& name, std::string_view text);
  /// Where a file of this name is to be written.
  std::filesystem::path path(const std::string& name) const { return temporary_ / name; }
  void commit();

 private:
  std::filesystem::path directory_;
  std::filesystem::path temporary_;
};

}  // namespace pliant::scene
