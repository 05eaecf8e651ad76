#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pliant::render {

/// A pixel: red, green, blue and alpha bytes, or one word 0xaarrggbb, which is what screens are made of.
enum class ChannelOrder { rgbaBytes, argbWord };

/// Opaque pixels, rows from the top; in bytes unless words were asked for.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< 4 * width * height
};

/// Two images of one height in one; the first may be empty.
Image beside(const Image& left, const Image& right);

/// The bytes of a PNG file.
std::string pngOf(const Image& image);

/// Writes a PNG file atomically (a temporary file beside it that is renamed). Throws base::InputError if the file
/// cannot be written.
void writePng(const Image& image, const std::filesystem::path& file);

}  // namespace pliant::render
