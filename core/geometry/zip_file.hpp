#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pliant::geometry {

struct ZipEntry {
  std::string name;
  std::string bytes;
};

/// A ZIP archive of compressed entries without a date, so that the same entries give the same bytes. Throws
/// base::InputError with the file's name as location.
void writeZip(const std::vector<ZipEntry>& entries, const std::filesystem::path& file);

}  // namespace pliant::geometry
