#pragma once
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace scantrove::test {

inline void requireVideo(bool condition, const char* what) {
  if (!condition) throw std::runtime_error(what);
}

/// Writes a video (MPEG-4 in the container of the file's extension) whose picture i has the grey 20 + 20 i
/// everywhere.
inline void writeTinyVideo(const std::filesystem::path& file, int frames, int width, int height) {
  AVFormatContext* format = nullptr;
  avformat_alloc_output_context2(&format, nullptr, nullptr, file.c_str());
  requireVideo(format != nullptr, "no container");
  const AVCodec* const encoder = avcodec_find_encoder(AV_CODEC_ID_MPEG4);
  AVCodecContext* codec = avcodec_alloc_context3(encoder);
  codec->width = width;
  codec->height = height;
  codec->pix_fmt = AV_PIX_FMT_YUV420P;
  codec->time_base = {1, 30};
  codec->bit_rate = 4'000'000;
  if ((format->oformat->flags & AVFMT_GLOBALHEADER) != 0) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  requireVideo(avcodec_open2(codec, encoder, nullptr) == 0, "no encoder");
  AVStream* const stream = avformat_new_stream(format, nullptr);
  stream->time_base = codec->time_base;
  avcodec_parameters_from_context(stream->codecpar, codec);
  requireVideo(avio_open(&format->pb, file.c_str(), AVIO_FLAG_WRITE) >= 0, "cannot write the video");
  requireVideo(avformat_write_header(format, nullptr) >= 0, "no header");
  AVFrame* picture = av_frame_alloc();
  AVPacket* packet = av_packet_alloc();
  for (int i = 0; i <= frames; ++i) {
    if (i < frames) {
      picture->format = codec->pix_fmt;
      picture->width = width;
      picture->height = height;
      picture->pts = i;
      requireVideo(av_frame_get_buffer(picture, 0) == 0, "no picture");
      for (int plane = 0; plane < 3; ++plane) {
        const int rows = plane == 0 ? height : (height + 1) / 2, value = plane == 0 ? 20 + 20 * i : 128;
        for (int y = 0; y < rows * picture->linesize[plane]; ++y)
          picture->data[plane][y] = static_cast<std::uint8_t>(value);
      }
    }
    avcodec_send_frame(codec, i < frames ? picture : nullptr);
    while (avcodec_receive_packet(codec, packet) == 0) {
      packet->duration = 1;  // without it, the edit list of an .mp4 file cuts off the last picture
      av_packet_rescale_ts(packet, codec->time_base, stream->time_base);
      packet->stream_index = stream->index;
      av_interleaved_write_frame(format, packet);
    }
    av_frame_unref(picture);
  }
  av_write_trailer(format);
  av_frame_free(&picture);
  av_packet_free(&packet);
  avcodec_free_context(&codec);
  avio_closep(&format->pb);
  avformat_free_context(format);
}

/// The grey of picture i after a decoder that maps 16 - 235 to 0 - 255.
inline int greyOfTinyVideo(int i) { return (20 + 20 * i - 16) * 255 / 219; }

}  // namespace scantrove::test
