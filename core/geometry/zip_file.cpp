#include "core/geometry/zip_file.hpp"

#include <array>
#include <cstdint>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/pending_file.hpp"

namespace pliant::geometry {

namespace {

/// The check sum of ISO 3309, which ZIP uses.
std::uint32_t checkSum(std::string_view bytes) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> values;
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = value & 1 ? 0xEDB88320u ^ (value >> 1) : value >> 1;
      values[i] = value;
    }
    return values;
  }();
  std::uint32_t sum = 0xFFFFFFFFu;
  for (const unsigned char byte : bytes) sum = table[(sum ^ byte) & 0xFF] ^ (sum >> 8);
  return ~sum;
}

/// Numbers with their lowest byte first.
void append(std::string& out, std::initializer_list<std::pair<std::uint32_t, int>> numbers) {
  for (const auto& [number, bytes] : numbers)
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(number >> (8 * i) & 0xFF);
}

}  // namespace

void writeZip(const std::vector<ZipEntry>& entries, const std::filesystem::path& file) {
  constexpr std::uint32_t firstOfJanuary1980 = 1 << 5 | 1;
  base::PendingFile output(file);
  std::string directory;
  std::uint64_t offset = 0;
  const auto size32 = [&](std::uint64_t size) {
    if (size > std::numeric_limits<std::uint32_t>::max())
      throw base::InputError(file.string(), "This archive would be larger than 4 GB.");
    return static_cast<std::uint32_t>(size);
  };
  for (const auto& [name, bytes] : entries) {
    const std::uint32_t sum = checkSum(bytes), size = size32(bytes.size()), at = size32(offset);
    const auto nameSize = static_cast<std::uint32_t>(name.size());
    std::string header;
    append(header, {{0x04034B50, 4},
                    {20, 2},
                    {0, 2},
                    {0, 2},
                    {0, 2},
                    {firstOfJanuary1980, 2},
                    {sum, 4},
                    {size, 4},
                    {size, 4},
                    {nameSize, 2},
                    {0, 2}});
    header += name;
    output.write(header);
    output.write(bytes);
    offset += header.size() + bytes.size();
    append(directory, {{0x02014B50, 4},
                       {20, 2},
                       {20, 2},
                       {0, 2},
                       {0, 2},
                       {0, 2},
                       {firstOfJanuary1980, 2},
                       {sum, 4},
                       {size, 4},
                       {size, 4},
                       {nameSize, 2},
                       {0, 2},
                       {0, 2},
                       {0, 2},
                       {0, 2},
                       {0, 4},
                       {at, 4}});
    directory += name;
  }
  const auto count = static_cast<std::uint32_t>(entries.size());
  const std::uint32_t start = size32(offset), length = size32(directory.size());
  append(directory, {{0x06054B50, 4}, {0, 2}, {0, 2}, {count, 2}, {count, 2}, {length, 4}, {start, 4}, {0, 2}});
  output.write(directory);
  output.commit();
}

}  // namespace pliant::geometry
