#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace pliant::base {

/// A file that appears whole or not at all: it is written under a temporary name beside its place, and renamed by
/// commit(). What is not committed goes with the object. Errors are base::InputError with the file's name as location
/// and the reason that the system gives, such as no space left on the device.
class PendingFile {
 public:
  /// Throws InputError if no file can be made there.
  explicit PendingFile(std::filesystem::path file);
  ~PendingFile();
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;

  void write(std::string_view bytes);
  /// All is written: the file is closed, still under its temporary name.
  void finish();
  /// Finishes, and puts the file in its place; one that was there is replaced.
  void commit();

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };
  [[noreturn]] void fail(int reason) const;

  std::filesystem::path file_;
  std::filesystem::path temporary_;  ///< empty: nothing to remove
  std::unique_ptr<std::FILE, Close> stream_;
};

/// One file, whole or not at all. Throws as PendingFile does.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace pliant::base
