#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace pliant::test {

/// A video as FFmpeg's demuxer and decoder read it, which share nothing with libtheora and libogg that wrote it.
struct DecodedVideo {
  struct Frame {
    int width = 0, height = 0;
    std::int64_t number = 0;  ///< its time, in pictures; one that repeats the one before is not there
    std::array<std::vector<std::uint8_t>, 3> planes;  ///< brightness, and blue and red difference of 2 x 2 pixels

    /// Red, green and blue of a pixel in [0, 255], by ITU-R BT.601.
    std::array<double, 3> color(int x, int y) const {
      const double light = 255.0 / 219 * (planes[0][static_cast<std::size_t>(y * width + x)] - 16);
      const auto chroma = static_cast<std::size_t>(y / 2 * ((width + 1) / 2) + x / 2);
      const double blue = 255.0 / 224 * (planes[1][chroma] - 128), red = 255.0 / 224 * (planes[2][chroma] - 128);
      return {light + 1.402 * red, light - 0.344136 * blue - 0.714136 * red, light + 1.772 * blue};
    }
    /// Mean difference of brightness, of 255.
    double differenceTo(const Frame& other) const {
      double sum = 0;
      for (std::size_t i = 0; i < planes[0].size(); ++i) sum += std::abs(planes[0][i] - other.planes[0][i]);
      return sum / static_cast<double>(planes[0].size());
    }
  };

  std::string problem;  ///< empty: it is a video of Theora in Ogg
  AVRational rate{};
  std::vector<Frame> frames;
};

inline DecodedVideo decodeVideo(const std::string& file) {
  DecodedVideo video;
  AVFormatContext* format = nullptr;
  if (avformat_open_input(&format, file.c_str(), nullptr, nullptr) != 0) {
    video.problem = "cannot be opened";
    return video;
  }
  AVCodecContext* decoder = avcodec_alloc_context3(nullptr);
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();
  const auto receive = [&] {
    while (avcodec_receive_frame(decoder, frame) == 0) {
      if (frame->format != AV_PIX_FMT_YUV420P) video.problem = "has other planes";
      DecodedVideo::Frame& taken = video.frames.emplace_back();
      taken.width = frame->width;
      taken.height = frame->height;
      taken.number = frame->best_effort_timestamp;
      for (std::size_t i = 0; i < 3; ++i) {
        const int width = i == 0 ? frame->width : (frame->width + 1) / 2;
        const int height = i == 0 ? frame->height : (frame->height + 1) / 2;
        for (int y = 0; y < height; ++y) {
          const std::uint8_t* row = frame->data[i] + y * frame->linesize[i];
          taken.planes[i].insert(taken.planes[i].end(), row, row + width);
        }
      }
    }
  };
  if (std::string(format->iformat->name) != "ogg" || avformat_find_stream_info(format, nullptr) < 0 ||
      format->nb_streams != 1 || format->streams[0]->codecpar->codec_id != AV_CODEC_ID_THEORA) {
    video.problem = "is no Theora in Ogg";
  } else if (avcodec_parameters_to_context(decoder, format->streams[0]->codecpar) < 0 ||
             avcodec_open2(decoder, avcodec_find_decoder(AV_CODEC_ID_THEORA), nullptr) < 0) {
    video.problem = "cannot be decoded";
  } else {
    decoder->pkt_timebase = format->streams[0]->time_base;
    video.rate = av_guess_frame_rate(format, format->streams[0], nullptr);
    while (av_read_frame(format, packet) == 0) {
      if (avcodec_send_packet(decoder, packet) != 0) video.problem = "has a broken packet";
      av_packet_unref(packet);
      receive();
    }
    avcodec_send_packet(decoder, nullptr);
    receive();
  }
  av_frame_free(&frame);
  av_packet_free(&packet);
  avcodec_free_context(&decoder);
  avformat_close_input(&format);
  return video;
}

}  // namespace pliant::test
