#include "core/image/jpeg_decoder.h"

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
    jpeg_.out_color_space = JCS_EXT_BGR;
    jpeg_start_decompress(&jpeg_);
    return true;
  }

  [[nodiscard]] cv::Size size() const {
    return {static_cast<int>(jpeg_.output_width), static_cast<int>(jpeg_.output_height)};
  }

  bool readRows(cv::Mat& image) {
    if (setjmp(handler_.on_error) != 0) {
      return false;
    }
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = image.ptr(static_cast<int>(jpeg_.output_scanline));
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

  [[nodiscard]] const char* reason() const { return handler_.reason; }

 private:
  JpegErrorHandler handler_{};
  jpeg_decompress_struct jpeg_{};
};

}  // namespace

Result<cv::Mat> decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name) {
  JpegDecoder decoder(bytes);
  cv::Mat image;
  if (decoder.start()) {
    image.create(decoder.size(), CV_8UC3);
    if (decoder.readRows(image)) {
      return image;
    }
  }
  return fail(name + " cannot be decoded: it is damaged (" + decoder.reason() + ").");
}

}  // namespace scantrove
