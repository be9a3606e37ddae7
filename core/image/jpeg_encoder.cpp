#include "core/image/jpeg_encoder.h"

#include <cstdlib>
#include <stdexcept>

#include "core/base/check.h"
#include "core/image/jpeg_errors.h"

namespace scantrove {
namespace {

class JpegEncoder {
 public:
  JpegEncoder() {
    jpeg_.err = jpeg_std_error(&handler_.base);
    handler_.base.error_exit = leaveJpeg;
    jpeg_create_compress(&jpeg_);
  }
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;
  ~JpegEncoder() {
    jpeg_destroy_compress(&jpeg_);
    std::free(bytes_);  // NOLINT(cppcoreguidelines-no-malloc): libjpeg's
  }

  bool encode(const cv::Mat& bgr, int quality) {
    if (setjmp(handler_.on_error) != 0) {
      return false;
    }
    jpeg_mem_dest(&jpeg_, &bytes_, &size_);
    jpeg_.image_width = static_cast<JDIMENSION>(bgr.cols);
    jpeg_.image_height = static_cast<JDIMENSION>(bgr.rows);
    jpeg_.input_components = 3;
    jpeg_.in_color_space = JCS_EXT_BGR;
    jpeg_set_defaults(&jpeg_);
    jpeg_set_quality(&jpeg_, quality, TRUE);
    jpeg_start_compress(&jpeg_, TRUE);
    while (jpeg_.next_scanline < jpeg_.image_height) {
      auto* row = const_cast<JSAMPROW>(bgr.ptr(static_cast<int>(jpeg_.next_scanline)));
      jpeg_write_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_compress(&jpeg_);
    return true;
  }

  [[nodiscard]] std::string bytes() const { return {reinterpret_cast<const char*>(bytes_), size_}; }
  [[nodiscard]] const char* reason() const { return handler_.reason; }

 private:
  JpegErrorHandler handler_{};
  jpeg_compress_struct jpeg_{};
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;
};

}  // namespace

std::string encodeJpeg(const cv::Mat& bgr, int quality) {
  SCANTROVE_CHECK(bgr.type() == CV_8UC3 && !bgr.empty());
  JpegEncoder encoder;
  if (!encoder.encode(bgr, quality))
    throw std::runtime_error(std::string("an image could not be encoded (") + encoder.reason() + ")");
  return encoder.bytes();
}

}  // namespace scantrove
