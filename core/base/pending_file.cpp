#include "core/base/pending_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "core/base/error.hpp"

namespace pliant::base {

PendingFile::PendingFile(std::filesystem::path file) : file_(std::move(file)) {
  std::filesystem::path temporary = file_;
  temporary += ".writing-" + std::to_string(::getpid());
  stream_.reset(std::fopen(temporary.c_str(), "wb"));
  if (!stream_) fail(errno);
  temporary_ = std::move(temporary);
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : file_(std::move(other.file_)),
      temporary_(std::exchange(other.temporary_, {})),
      stream_(std::move(other.stream_)) {}

PendingFile::~PendingFile() {
  stream_.reset();
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void PendingFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size()) fail(errno);
}

void PendingFile::finish() {
  if (stream_ && std::fclose(stream_.release()) != 0) fail(errno);
}

void PendingFile::commit() {
  finish();
  std::error_code error;
  std::filesystem::rename(temporary_, file_, error);
  if (error) fail(error.value());
  temporary_.clear();
}

void PendingFile::fail(int reason) const {
  throw InputError(file_.string(), "The file cannot be written: " + std::generic_category().message(reason) + ".");
}

void writeFile(const std::filesystem::path& file, std::string_view bytes) {
  PendingFile pending(file);
  pending.write(bytes);
  pending.commit();
}

}  // namespace pliant::base
