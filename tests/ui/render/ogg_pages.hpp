#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pliant::test {

/// A page of an Ogg file (RFC 3533).
struct OggPage {
  int flags = 0;  ///< 2: the stream begins, 4: it ends
  std::int64_t granule = 0;
  std::uint32_t number = 0;
  bool sumHolds = false;  ///< its check sum
  std::string body;
};

/// Empty if the file is anything but whole pages.
inline std::vector<OggPage> oggPages(const std::string& bytes) {
  const auto little = [&](std::size_t at, int size) {
    std::uint64_t value = 0;
    for (int i = size - 1; i >= 0; --i) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    return value;
  };
  std::vector<OggPage> pages;
  for (std::size_t at = 0; at < bytes.size();) {
    if (bytes.size() < at + 27 || bytes.compare(at, 4, "OggS") != 0) return {};
    const std::size_t segments = little(at + 26, 1), head = 27 + segments;
    if (bytes.size() < at + head) return {};
    std::size_t length = 0;
    for (std::size_t i = 0; i < segments; ++i) length += little(at + 27 + i, 1);
    if (bytes.size() < at + head + length) return {};
    OggPage page;
    page.flags = static_cast<int>(little(at + 5, 1));
    page.granule = static_cast<std::int64_t>(little(at + 6, 8));
    page.number = static_cast<std::uint32_t>(little(at + 18, 4));
    page.body = bytes.substr(at + head, length);
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < head + length; ++i) {
      sum ^= (i >= 22 && i < 26 ? 0u : static_cast<std::uint8_t>(bytes[at + i])) << 24;
      for (int bit = 0; bit < 8; ++bit) sum = sum & 0x80000000u ? sum << 1 ^ 0x04c11db7u : sum << 1;
    }
    page.sumHolds = sum == little(at + 22, 4);
    pages.push_back(std::move(page));
    at += head + length;
  }
  return pages;
}

}  // namespace pliant::test
