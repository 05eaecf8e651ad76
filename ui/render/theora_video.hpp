#pragma once

#include <filesystem>
#include <memory>

#include "ui/render/image.hpp"

namespace pliant::render {

/// Pictures in a second, as a fraction: 100/3 where they are 30 ms apart.
struct FrameRate {
  static constexpr double fastest = 1000;  ///< [1/s]

  int numerator = 0;
  int denominator = 1;

  double perSecond() const { return static_cast<double>(numerator) / denominator; }
};

/// The fraction with the smallest denominator up to 1000 that is `perSecond` to a part in a million, else the nearest
/// with 1000. Throws base::InputError unless it lies between 0.01 and FrameRate::fastest.
FrameRate frameRate(double perSecond);

/// A video without sound (.ogv: Theora in Ogg, 4:2:0), written whole or not at all; the same pictures give the same
/// bytes. VTK's own writer is not used: it has whole rates only, a random serial number, and overlooks a disk that is
/// full.
class TheoraVideo {
 public:
  /// Sizes as OffscreenTarget takes them. Throws base::InputError if the file cannot be made.
  TheoraVideo(const std::filesystem::path& file, int width, int height, FrameRate rate);
  ~TheoraVideo();

  /// The next picture, in rgbaBytes and of the video's size. Throws base::InputError if it cannot be written.
  void add(const Image& image);
  /// There must have been a picture. Without this there will be no file.
  void commit();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
