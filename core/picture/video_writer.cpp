#include "core/picture/video_writer.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <string>
#include <utility>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace scantrove {

namespace {

constexpr int kEncoderThreads = 2;
constexpr const char* kQuality = "28";  // constant quality of VP9, 0 (best) .. 63
constexpr const char* kSpeed = "5";     // 0 (slow) .. 8

std::string reasonOfEncoder(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

}  // namespace

class VideoWriter::Encoder {
  template <auto function>
  struct FreeByAddress {
    template <class T>
    void operator()(T* pointer) const {
      function(&pointer);
    }
  };
  struct CloseOutput {
    void operator()(AVFormatContext* context) const {
      if (context->pb != nullptr) avio_closep(&context->pb);
      avformat_free_context(context);
    }
  };
  struct FreeConverter {
    void operator()(SwsContext* context) const { sws_freeContext(context); }
  };

 public:
  explicit Encoder(const std::filesystem::path& file) : name_(file.string()) {}

  [[nodiscard]] Result<void> open(int width, int height, int frames_per_second) {
    av_log_set_level(AV_LOG_QUIET);
    const AVCodec* encoder = avcodec_find_encoder_by_name("libvpx-vp9");
    if (encoder == nullptr) encoder = avcodec_find_encoder_by_name("libvpx");
    if (encoder == nullptr)
      return fail("This libavcodec has no encoder of VP9 or VP8.",
                  "Install one with libvpx, or write a PNG.");
    AVFormatContext* format = nullptr;
    const int made = avformat_alloc_output_context2(&format, nullptr, "webm", nullptr);
    format_.reset(format);
    codec_.reset(avcodec_alloc_context3(encoder));
    picture_.reset(av_frame_alloc());
    packet_.reset(av_packet_alloc());
    if (made < 0 || !codec_ || !picture_ || !packet_) return failure(made < 0 ? made : AVERROR(ENOMEM));
    format_->flags |= AVFMT_FLAG_BITEXACT;  // the same images give the same bytes
    codec_->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
    codec_->width = width;
    codec_->height = height;
    codec_->pix_fmt = AV_PIX_FMT_YUV420P;
    codec_->time_base = {1, frames_per_second};
    codec_->framerate = {frames_per_second, 1};
    codec_->thread_count = kEncoderThreads;
    codec_->color_range = AVCOL_RANGE_MPEG;
    codec_->colorspace = AVCOL_SPC_BT709;
    codec_->bit_rate = 0;  // as the constant quality needs
    SCANTROVE_TRY(openEncoder(*encoder));
    return openFile(width, height);
  }

  [[nodiscard]] Result<void> add(const cv::Mat& image) {
    picture_->format = codec_->pix_fmt;
    picture_->width = codec_->width;
    picture_->height = codec_->height;
    picture_->color_range = codec_->color_range;
    picture_->colorspace = codec_->colorspace;
    picture_->pts = next_++;
    if (const int code = av_frame_get_buffer(picture_.get(), 0); code < 0) return failure(code);
    const std::array<const std::uint8_t*, 4> planes{image.data};
    const std::array<int, 4> strides{static_cast<int>(image.step[0])};
    sws_scale(converter_.get(), planes.data(), strides.data(), 0, image.rows, picture_->data,
              picture_->linesize);
    const int sent = avcodec_send_frame(codec_.get(), picture_.get());
    av_frame_unref(picture_.get());
    return sent < 0 ? failure(sent) : writePackets();
  }

  [[nodiscard]] Result<void> finish() {
    if (const int code = avcodec_send_frame(codec_.get(), nullptr); code < 0) return failure(code);
    SCANTROVE_TRY(writePackets());
    if (const int code = av_write_trailer(format_.get()); code < 0) return failure(code);
    const int closed = avio_closep(&format_->pb);
    return closed < 0 ? failure(closed) : Result<void>();
  }

 private:
  [[nodiscard]] Result<void> failure(int code) const {
    return fail("Cannot write the video " + name_ + ": " + reasonOfEncoder(code) + ".",
                "Check that the folder can be written to and that the disk is not full.");
  }

  [[nodiscard]] Result<void> openEncoder(const AVCodec& encoder) {
    AVDictionary* options = nullptr;
    av_dict_set(&options, "crf", kQuality, 0);
    av_dict_set(&options, "cpu-used", kSpeed, 0);
    av_dict_set(&options, "deadline", "good", 0);
    const int code = avcodec_open2(codec_.get(), &encoder, &options);
    av_dict_free(&options);
    return code < 0 ? failure(code) : Result<void>();
  }

  [[nodiscard]] Result<void> openFile(int width, int height) {
    stream_ = avformat_new_stream(format_.get(), nullptr);
    if (stream_ == nullptr) return failure(AVERROR(ENOMEM));
    stream_->time_base = codec_->time_base;
    stream_->avg_frame_rate = codec_->framerate;
    int code = avcodec_parameters_from_context(stream_->codecpar, codec_.get());
    if (code >= 0) code = avio_open(&format_->pb, ("file:" + name_).c_str(), AVIO_FLAG_WRITE);
    if (code >= 0) code = avformat_write_header(format_.get(), nullptr);
    if (code < 0) return failure(code);
    converter_.reset(sws_getContext(width, height, AV_PIX_FMT_BGR24, width, height, AV_PIX_FMT_YUV420P,
                                    SWS_BILINEAR | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
    if (!converter_) return failure(AVERROR(ENOMEM));
    constexpr int kUnchanged = 1 << 16;
    sws_setColorspaceDetails(converter_.get(), sws_getCoefficients(SWS_CS_DEFAULT), 1,
                             sws_getCoefficients(SWS_CS_ITU709), 0, 0, kUnchanged, kUnchanged);
    return {};
  }

  [[nodiscard]] Result<void> writePackets() {
    while (true) {
      const int received = avcodec_receive_packet(codec_.get(), packet_.get());
      if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return {};
      if (received < 0) return failure(received);
      packet_->duration = 1;
      av_packet_rescale_ts(packet_.get(), codec_->time_base, stream_->time_base);
      packet_->stream_index = stream_->index;
      const int written = av_interleaved_write_frame(format_.get(), packet_.get());
      av_packet_unref(packet_.get());
      if (written < 0) return failure(written);
    }
  }

  std::string name_;
  std::unique_ptr<AVFormatContext, CloseOutput> format_;
  std::unique_ptr<AVCodecContext, FreeByAddress<avcodec_free_context>> codec_;
  std::unique_ptr<AVFrame, FreeByAddress<av_frame_free>> picture_;
  std::unique_ptr<AVPacket, FreeByAddress<av_packet_free>> packet_;
  std::unique_ptr<SwsContext, FreeConverter> converter_;
  AVStream* stream_ = nullptr;  // of format_
  std::int64_t next_ = 0;       // frame
};

VideoWriter::VideoWriter(std::unique_ptr<Encoder> encoder) : encoder_(std::move(encoder)) {}
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;
VideoWriter::~VideoWriter() = default;

Result<VideoWriter> VideoWriter::create(const std::filesystem::path& file, int width, int height,
                                        int frames_per_second) {
  auto encoder = std::make_unique<Encoder>(file);
  SCANTROVE_TRY(encoder->open(width, height, frames_per_second));
  return VideoWriter(std::move(encoder));
}

Result<void> VideoWriter::add(const cv::Mat& image) { return encoder_->add(image); }

Result<void> VideoWriter::finish() { return encoder_->finish(); }

}  // namespace scantrove
