#include "core/image/jpeg_decoder.h"

#include <vector>

#include "core/image/jpeg_errors.h"

#include <jerror.h>  // after jpeglib.h

namespace scantrove {

namespace {

/// Messages of level -1 are warnings: the picture is not what was recorded, but for a few that tell nothing.
void onMessage(j_common_ptr jpeg, int level) {
  const int code = jpeg->err->msg_code;
  const bool is_harmless = code == JWRN_EXTRANEOUS_DATA || code == JWRN_TOO_MUCH_DATA ||
                           code == JWRN_ADOBE_XFORM || code == JWRN_BOGUS_PROGRESSION;
  if (level < 0 && !is_harmless) {
    leaveJpeg(jpeg);
  }
}

/// Cyan, magenta, yellow and black to BGR, as print programs show them without a color profile. Adobe's store
/// the light that an ink leaves, others the ink.
void inksToBgr(std::span<const std::uint8_t> inks, bool is_by_adobe, std::uint8_t* bgr) {
  const auto light = [&](std::size_t at) { return is_by_adobe ? inks[at] : 255 - inks[at]; };
  for (std::size_t at = 0; at + 4 <= inks.size(); at += 4) {
    for (const std::size_t ink : {std::size_t{2}, std::size_t{1}, std::size_t{0}})
      *bgr++ = static_cast<std::uint8_t>((light(at + ink) * light(at + 3) + 127) / 255);
  }
}

class JpegDecoder {
 public:
  explicit JpegDecoder(std::span<const std::uint8_t> bytes) {
    jpeg_.err = jpeg_std_error(&handler_.base);
    handler_.base.error_exit = leaveJpeg;
    handler_.base.emit_message = onMessage;
    jpeg_create_decompress(&jpeg_);
    jpeg_mem_src(&jpeg_, bytes.data(), static_cast<unsigned long>(bytes.size()));
  }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;
  ~JpegDecoder() { jpeg_destroy_decompress(&jpeg_); }

  bool start() {
    if (setjmp(handler_.on_error) != 0) {
      return false;
    }
    jpeg_read_header(&jpeg_, TRUE);
    is_of_inks_ = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
    jpeg_.out_color_space = is_of_inks_ ? JCS_CMYK : JCS_EXT_BGR;
    jpeg_start_decompress(&jpeg_);
    return true;
  }

  [[nodiscard]] cv::Size size() const {
    return {static_cast<int>(jpeg_.output_width), static_cast<int>(jpeg_.output_height)};
  }

  /// Bytes of a row as it comes, before its inks become colors.
  [[nodiscard]] std::size_t rowBytes() const {
    return std::size_t{jpeg_.output_width} * static_cast<std::size_t>(jpeg_.output_components);
  }

  /// `row`: of rowBytes().
  bool readRows(cv::Mat& image, std::vector<std::uint8_t>& row) {
    if (setjmp(handler_.on_error) != 0) {
      return false;
    }
    while (jpeg_.output_scanline < jpeg_.output_height) {
      std::uint8_t* const pixels = image.ptr(static_cast<int>(jpeg_.output_scanline));
      JSAMPROW target = is_of_inks_ ? row.data() : pixels;
      jpeg_read_scanlines(&jpeg_, &target, 1);
      if (is_of_inks_) inksToBgr(row, jpeg_.saw_Adobe_marker != FALSE, pixels);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

  [[nodiscard]] const char* reason() const { return handler_.reason; }

 private:
  JpegErrorHandler handler_{};
  jpeg_decompress_struct jpeg_{};
  bool is_of_inks_ = false;
};

}  // namespace

Result<cv::Mat> decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name) {
  JpegDecoder decoder(bytes);
  cv::Mat image;
  if (decoder.start()) {
    image.create(decoder.size(), CV_8UC3);
    std::vector<std::uint8_t> row(decoder.rowBytes());
    if (decoder.readRows(image, row)) {
      return image;
    }
  }
  return fail(name + " cannot be decoded: it is damaged (" + decoder.reason() + ").");
}

}  // namespace scantrove
