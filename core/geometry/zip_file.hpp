#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pliant::geometry {

struct ZipEntry {
  std::string name;
  std::string bytes;
};

/// A ZIP archive of entries that are stored as they are, not compressed, without a date, so that the same entries give
/// the same bytes. Throws base::InputError with the file's name as location, also if it would be larger than 4 GB.
void writeZip(const std::vector<ZipEntry>& entries, const std::filesystem::path& file);

}  // namespace pliant::geometry
