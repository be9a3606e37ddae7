#include "core/image/png_decoder.h"

#include <spng.h>

#include <memory>
#include <opencv2/imgproc.hpp>

#include "core/image/file_bytes.h"
#include "core/image/image_header.h"

namespace scantrove {

namespace {

using Bytes = std::span<const std::uint8_t>;

/// Limit of non-pixel chunks, each and together, inflated: more than any colour profile or XMP.
constexpr std::size_t kMaxMetadataBytes = 16 << 20;

class PngDecoder {
 public:
  PngDecoder(Bytes bytes, const std::string& name)
      : bytes_(bytes), name_(name), context_(spng_ctx_new(0), &spng_ctx_free) {}

  Result<void> readHeader() {
    int error = spng_set_image_limits(context_.get(), kLongestImageSide_px, kLongestImageSide_px);
    if (error == 0) error = spng_set_chunk_limits(context_.get(), kMaxMetadataBytes, kMaxMetadataBytes);
    if (error == 0) error = spng_set_png_buffer(context_.get(), bytes_.data(), bytes_.size());
    if (error == 0) error = spng_get_ihdr(context_.get(), &header_);
    return check(error);
  }

  [[nodiscard]] bool is16Bit() const { return header_.bit_depth == 16; }
  [[nodiscard]] int channels() const {
    switch (header_.color_type) {
      case SPNG_COLOR_TYPE_GRAYSCALE:
        return 1;
      case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
        return 2;
      case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
        return 4;
      default:
        return 3;
    }
  }

  [[nodiscard]] Result<cv::Mat> decodeGray() {
    return is16Bit() ? decode(CV_16UC1, SPNG_FMT_PNG) : decode(CV_8UC1, SPNG_FMT_G8);
  }

  [[nodiscard]] Result<cv::Mat> decodeRgba() { return decode(CV_8UC4, SPNG_FMT_RGBA8); }

  [[nodiscard]] Result<cv::Mat> decodeColor() {
    Result<cv::Mat> image = decode(CV_8UC3, SPNG_FMT_RGB8);
    if (image) cv::cvtColor(*image, *image, cv::COLOR_RGB2BGR);
    return image;
  }

 private:
  Result<cv::Mat> decode(int type, spng_format format) {
    cv::Mat image(static_cast<int>(header_.height), static_cast<int>(header_.width), type);
    SCANTROVE_TRY(
        check(spng_decode_image(context_.get(), image.data, image.total() * image.elemSize(), format, 0)));
    // A truncated file may lack only the last chunk's checksum, which libspng does not read.
    SCANTROVE_TRY(check(spng_decode_chunks(context_.get())));
    if (bytes_.size() < textOf(bytes_).rfind("IEND") + 8) return truncated();
    return image;
  }

  [[nodiscard]] tl::unexpected<Error> truncated() const {
    return fail(name_ + " is truncated (" + std::to_string(bytes_.size()) + " bytes).");
  }

  [[nodiscard]] Result<void> check(int error) const {
    if (error == 0) return {};
    if (error == SPNG_IO_EOF) return truncated();
    return fail(name_ + " cannot be decoded: it is damaged (" + spng_strerror(error) + ").");
  }

  Bytes bytes_;
  const std::string& name_;
  std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context_;
  spng_ihdr header_{};
};

}  // namespace

Result<cv::Mat> decodeColorPng(Bytes bytes, const std::string& name) {
  PngDecoder decoder(bytes, name);
  SCANTROVE_TRY(decoder.readHeader());
  return decoder.decodeColor();
}

Result<cv::Mat> decodeGrayPng(Bytes bytes, const std::string& name) {
  PngDecoder decoder(bytes, name);
  SCANTROVE_TRY(decoder.readHeader());
  if (decoder.channels() == 1) return decoder.decodeGray();
  return fail(name + " is " + (decoder.is16Bit() ? "16-bit" : "8-bit") + " with " +
                  std::to_string(decoder.channels()) +
                  " channels, not one: depth and label images are grey and 16-bit, masks grey and 8-bit.",
              "Check that this is the right file or folder, and save it as a grey PNG without alpha.");
}

Result<cv::Mat> decodeAnyPng(Bytes bytes, const std::string& name) {
  PngDecoder decoder(bytes, name);
  SCANTROVE_TRY(decoder.readHeader());
  return decoder.channels() == 1 ? decoder.decodeGray() : decoder.decodeColor();
}

Result<cv::Mat> decodeRgbaPng(Bytes bytes, const std::string& name) {
  PngDecoder decoder(bytes, name);
  SCANTROVE_TRY(decoder.readHeader());
  if (decoder.channels() == 4 && !decoder.is16Bit()) return decoder.decodeRgba();
  return fail(name + " is no 8-bit PNG with 4 channels.");
}

}  // namespace scantrove
