#include "ui/render/theora_video.hpp"

#include <theora/theoraenc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/pending_file.hpp"
#include "core/base/units.hpp"

namespace pliant::render {
namespace {

constexpr int blockSize = 16;             // Theora's pictures are made of these
constexpr int quality = 56;               // of 63: thin lines stay clean
constexpr int keyframeShift = 6;          // a whole picture at least every 64, from where players can begin
constexpr int serialNumber = 0x506c6961;  // there is one stream in the file, so any number is as good
constexpr double slowest = 0.01;          // [1/s]
constexpr double rateTolerance = 1e-6;
constexpr int largestDenominator = 1000;

int roundedUp(int pixels) { return (pixels + blockSize - 1) / blockSize * blockSize; }

struct Plane {
  int width, height;
  std::vector<std::uint8_t> values;

  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  std::uint8_t& at(int x, int y) { return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + x]; }
};

/// A picture as brightness and, for every two by two pixels, two differences of colour: ITU-R BT.601, whose weights of
/// red, green and blue are here in 1/256. What is beyond the picture's right and lower edge repeats that edge.
struct ColorPlanes {
  Plane luma, blue, red;

  ColorPlanes(int width, int height) : luma(width, height), blue(width / 2, height / 2), red(width / 2, height / 2) {}

  void take(const Image& image) {
    const auto pixel = [&image](int x, int y) {
      x = std::min(x, image.width - 1);
      y = std::min(y, image.height - 1);
      return &image.pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + x)];
    };
    for (int y = 0; y < luma.height; y += 2)
      for (int x = 0; x < luma.width; x += 2) {
        std::array<int, 3> sum{};
        for (const auto& [i, j] : {std::array{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
          const std::uint8_t* rgb = pixel(x + i, y + j);
          luma.at(x + i, y + j) =
              static_cast<std::uint8_t>(16 + ((66 * rgb[0] + 129 * rgb[1] + 25 * rgb[2] + 128) >> 8));
          for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb[c];
        }
        blue.at(x / 2, y / 2) =
            static_cast<std::uint8_t>(128 + ((-38 * sum[0] - 74 * sum[1] + 112 * sum[2] + 512) >> 10));
        red.at(x / 2, y / 2) =
            static_cast<std::uint8_t>(128 + ((112 * sum[0] - 94 * sum[1] - 18 * sum[2] + 512) >> 10));
      }
  }
};

void require(bool succeeded) {
  if (!succeeded) throw std::runtime_error("libtheora does not encode this video.");
}

}  // namespace

FrameRate frameRate(double perSecond) {
  if (!(perSecond >= slowest && perSecond <= FrameRate::fastest))
    throw base::InputError(
        "", "A video needs between 0.01 and 1000 pictures a second, not " + base::formatQuantity(perSecond, {}) + ".");
  for (int denominator = 1;; ++denominator) {
    const double numerator = std::round(perSecond * denominator);
    if (denominator == largestDenominator ||
        std::abs(numerator - perSecond * denominator) <= rateTolerance * perSecond * denominator)
      return {static_cast<int>(numerator), denominator};
  }
}

struct TheoraVideo::Parts {
  base::PendingFile file;
  ColorPlanes planes;
  th_enc_ctx* encoder = nullptr;
  ogg_stream_state stream{};
  bool holdsPicture = false;  ///< in `planes`, not encoded yet: the last picture has to be marked as such

  Parts(const std::filesystem::path& place, int width, int height, FrameRate rate)
      : file(place), planes(roundedUp(width), roundedUp(height)) {
    th_info information;
    th_info_init(&information);
    information.frame_width = static_cast<ogg_uint32_t>(planes.luma.width);
    information.frame_height = static_cast<ogg_uint32_t>(planes.luma.height);
    information.pic_width = static_cast<ogg_uint32_t>(width);
    information.pic_height = static_cast<ogg_uint32_t>(height);
    information.colorspace = TH_CS_ITU_REC_470BG;
    information.pixel_fmt = TH_PF_420;
    information.quality = quality;
    information.keyframe_granule_shift = keyframeShift;
    information.fps_numerator = static_cast<ogg_uint32_t>(rate.numerator);
    information.fps_denominator = static_cast<ogg_uint32_t>(rate.denominator);
    information.aspect_numerator = information.aspect_denominator = 1;
    encoder = th_encode_alloc(&information);
    th_info_clear(&information);
    ogg_stream_init(&stream, serialNumber);
  }
  ~Parts() {
    ogg_stream_clear(&stream);
    th_encode_free(encoder);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void writeHeader() {
    require(encoder != nullptr);
    th_comment comment;
    th_comment_init(&comment);
    ogg_packet packet;
    while (th_encode_flushheader(encoder, &comment, &packet) > 0) writePage(packet);
    th_comment_clear(&comment);
  }

  void encode(bool last) {
    th_ycbcr_buffer buffer;
    const std::array<Plane*, 3> all{&planes.luma, &planes.blue, &planes.red};
    for (std::size_t i = 0; i < all.size(); ++i)
      buffer[i] = {all[i]->width, all[i]->height, all[i]->width, all[i]->values.data()};
    require(th_encode_ycbcr_in(encoder, buffer) == 0);
    ogg_packet packet;
    // Every picture has a page of its own, from which players take its time: a picture that repeats the one before is
    // empty, and some do not count those.
    while (th_encode_packetout(encoder, last, &packet) > 0) writePage(packet);
  }

  void writePage(ogg_packet& packet) {
    ogg_stream_packetin(&stream, &packet);
    ogg_page page;
    while (ogg_stream_flush(&stream, &page) != 0) {
      file.write({reinterpret_cast<const char*>(page.header), static_cast<std::size_t>(page.header_len)});
      file.write({reinterpret_cast<const char*>(page.body), static_cast<std::size_t>(page.body_len)});
    }
  }
};

TheoraVideo::TheoraVideo(const std::filesystem::path& file, int width, int height, FrameRate rate)
    : parts_(std::make_unique<Parts>(file, width, height, rate)) {
  parts_->writeHeader();
}

TheoraVideo::~TheoraVideo() = default;

void TheoraVideo::add(const Image& image) {
  if (parts_->holdsPicture) parts_->encode(false);
  parts_->planes.take(image);
  parts_->holdsPicture = true;
}

void TheoraVideo::commit() {
  parts_->encode(true);
  parts_->file.commit();
}

}  // namespace pliant::render
