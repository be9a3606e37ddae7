#include "core/capture/video_frames.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <string>
#include <utility>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
#include <libswscale/swscale.h>
}

#include "core/base/regular_file.h"
#include "core/image/image_header.h"

namespace scantrove {

namespace {

/// Containers of phones and depth cameras. Others (playlists) could name further files.
constexpr const char* kContainers = "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm";
/// Packets in a row that may be damaged before the video is given up.
constexpr int kMaxDamagedPackets = 100;
constexpr int kVideoThreads = 2;

std::string reasonOf(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

}  // namespace

/// An open video, positioned at its start.
class VideoFrames::Decoder {
  template <auto function>
  struct Free {
    template <class T>
    void operator()(T* pointer) const {
      function(&pointer);
    }
  };
  struct FreeScaler {
    void operator()(SwsContext* context) const { sws_freeContext(context); }
  };

 public:
  explicit Decoder(const std::filesystem::path& file) : name_(file.string()) {}

  [[nodiscard]] Result<void> open() {
    SCANTROVE_TRY(checkRegularFile(name_));
    av_log_set_level(AV_LOG_QUIET);
    AVDictionary* options = nullptr;
    av_dict_set(&options, "format_whitelist", kContainers, 0);
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    AVFormatContext* format = nullptr;
    const int opened = avformat_open_input(&format, ("file:" + name_).c_str(), nullptr, &options);
    av_dict_free(&options);
    if (opened < 0) return fail(name_ + " is no video that can be read (" + reasonOf(opened) + ").");
    format_.reset(format);
    const int found = avformat_find_stream_info(format, nullptr);
    const AVCodec* codec = nullptr;
    stream_ = found < 0 ? found : av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (stream_ < 0) return fail(name_ + " has no video stream (" + reasonOf(stream_) + ").");
    return openCodec(*codec, *format->streams[stream_]->codecpar);
  }

  /// The next picture, converted if it `is_wanted`. Error: also at the end.
  [[nodiscard]] Result<cv::Mat> next(bool is_wanted) {
    for (int damaged = 0; damaged < kMaxDamagedPackets;) {
      const int received = avcodec_receive_frame(codec_.get(), picture_.get());
      if (received == 0) {
        Result<cv::Mat> image = is_wanted ? convert() : cv::Mat();
        av_frame_unref(picture_.get());
        return image;
      }
      if (received == AVERROR_EOF) return fail(name_ + " ends before this frame.");
      if (received != AVERROR(EAGAIN) || !sendPacket()) ++damaged;
    }
    return fail(name_ + " is damaged: no picture can be decoded.");
  }

 private:
  [[nodiscard]] Result<void> openCodec(const AVCodec& codec, const AVCodecParameters& parameters) {
    codec_.reset(avcodec_alloc_context3(&codec));
    picture_.reset(av_frame_alloc());
    packet_.reset(av_packet_alloc());
    if (!codec_ || !picture_ || !packet_) return fail("There is no memory to decode " + name_ + ".");
    SCANTROVE_TRY(checkImageSize({static_cast<std::uint32_t>(std::max(parameters.width, 0)),
                                  static_cast<std::uint32_t>(std::max(parameters.height, 0))},
                                 name_));
    int code = avcodec_parameters_to_context(codec_.get(), &parameters);
    codec_->max_pixels = kMaxImagePixels;  // a stream may change its size
    codec_->thread_count = kVideoThreads;
    if (code >= 0) code = avcodec_open2(codec_.get(), &codec, nullptr);
    if (code < 0) return fail(name_ + " cannot be decoded (" + reasonOf(code) + ").");
    return {};
  }

  /// Feeds the decoder, at the end of the file with the end. False if a packet is damaged.
  [[nodiscard]] bool sendPacket() {
    while (true) {
      const int read = av_read_frame(format_.get(), packet_.get());
      if (read == AVERROR(EAGAIN)) return false;
      if (read < 0) return avcodec_send_packet(codec_.get(), nullptr) == 0;
      const bool is_mine = packet_->stream_index == stream_;
      const int sent = is_mine ? avcodec_send_packet(codec_.get(), packet_.get()) : 0;
      av_packet_unref(packet_.get());
      if (is_mine) return sent == 0;
    }
  }

  [[nodiscard]] Result<cv::Mat> convert() {
    const int width = picture_->width, height = picture_->height;
    SCANTROVE_TRY(checkImageSize(
        {static_cast<std::uint32_t>(std::max(width, 0)), static_cast<std::uint32_t>(std::max(height, 0))},
        name_));
    scaler_.reset(sws_getCachedContext(scaler_.release(), width, height,
                                       static_cast<AVPixelFormat>(picture_->format), width, height,
                                       AV_PIX_FMT_BGR24, SWS_BILINEAR, nullptr, nullptr, nullptr));
    if (!scaler_) return fail(name_ + " has pictures of a format that cannot be converted.");
    setColors();
    // The scaler writes whole vectors, beyond the end of a row and of the last one.
    constexpr int kVectorPixels = 32;
    const int padded_width = (width + kVectorPixels - 1) / kVectorPixels * kVectorPixels;
    cv::Mat padded(height + 1, padded_width, CV_8UC3);
    std::array<std::uint8_t*, 4> planes{padded.data};
    std::array<int, 4> strides{static_cast<int>(padded.step[0])};
    if (sws_scale(scaler_.get(), picture_->data, picture_->linesize, 0, height, planes.data(),
                  strides.data()) != height)
      return fail(name_ + " has a picture that cannot be converted.");
    const cv::Mat image = padded(cv::Rect(0, 0, width, height));
    return image.isContinuous() ? image : image.clone();
  }

  /// The picture's own matrix and range; untagged pictures have those of their size's television standard.
  void setColors() {
    constexpr int kUnchanged = 1 << 16, kHighDefinitionRows = 720;
    const int usual = picture_->height >= kHighDefinitionRows ? SWS_CS_ITU709 : SWS_CS_ITU601;
    const int matrix = picture_->colorspace == AVCOL_SPC_UNSPECIFIED ? usual : picture_->colorspace;
    sws_setColorspaceDetails(scaler_.get(), sws_getCoefficients(matrix),
                             picture_->color_range == AVCOL_RANGE_JPEG ? 1 : 0,
                             sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, kUnchanged, kUnchanged);
  }

  std::string name_;
  std::unique_ptr<AVFormatContext, Free<avformat_close_input>> format_;
  std::unique_ptr<AVCodecContext, Free<avcodec_free_context>> codec_;
  std::unique_ptr<AVFrame, Free<av_frame_free>> picture_;
  std::unique_ptr<AVPacket, Free<av_packet_free>> packet_;
  std::unique_ptr<SwsContext, FreeScaler> scaler_;
  int stream_ = -1;
};

VideoFrames::VideoFrames(std::filesystem::path file) : file_(std::move(file)) {}

VideoFrames::~VideoFrames() = default;

Result<cv::Mat> VideoFrames::frame(int position) {
  if (!last_.empty() && position == next_ - 1) return last_;
  if (!decoder_ || position < next_) {
    decoder_ = std::make_unique<Decoder>(file_);
    next_ = 0;
    if (const auto opened = decoder_->open(); !opened) {
      decoder_.reset();
      return fail(opened.error());
    }
  }
  last_.release();
  for (; next_ <= position; ++next_) {
    auto image = decoder_->next(next_ == position);
    if (!image) return image;
    last_ = *image;
  }
  return last_;
}

}  // namespace scantrove
