#include "core/image/png_decoder.h"

#include <png.h>

#include <cstdio>
#include <cstring>
#include <vector>

#include "core/image/image_header.h"

namespace scantrove {

namespace {

/// What libpng's callbacks share. It leaves a function that fails by longjmp, so whatever calls it between
/// setjmp and its return has no object with a destructor.
struct Input {
  std::span<const std::uint8_t> bytes;
  char reason[160] = "";
};

void readInput(png_structp png, png_bytep out, png_size_t size) {
  auto* const input = static_cast<Input*>(png_get_io_ptr(png));
  if (size > input->bytes.size()) {
    png_error(png, "it ends too early");
  }
  std::memcpy(out, input->bytes.data(), size);
  input->bytes = input->bytes.subspan(size);
}

[[noreturn]] void onError(png_structp png, png_const_charp message) {
  auto* const input = static_cast<Input*>(png_get_error_ptr(png));
  std::snprintf(input->reason, sizeof input->reason, "%s", message);
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

class PngDecoder {
 public:
  explicit PngDecoder(Input& input)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, onError, onWarning)),
        info_(png_create_info_struct(png_)) {
    png_set_read_fn(png_, &input, readInput);
    png_set_user_limits(png_, kLongestImageSide_px, kLongestImageSide_px);
  }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool readHeader() {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    png_read_info(png_, info_);
    return true;
  }

  [[nodiscard]] bool isColor() const { return (png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) != 0; }
  [[nodiscard]] int channels() const {
    return png_get_color_type(png_, info_) == PNG_COLOR_TYPE_PALETTE ? 3 : png_get_channels(png_, info_);
  }
  [[nodiscard]] bool is16Bit() const { return png_get_bit_depth(png_, info_) == 16; }
  [[nodiscard]] cv::Size size() const {
    return {static_cast<int>(png_get_image_width(png_, info_)),
            static_cast<int>(png_get_image_height(png_, info_))};
  }

  /// Decodes to BGR of 8 bits, or as it is; `rows` points to each row of an image that takes it.
  bool readRows(bool to_color, std::vector<png_bytep>& rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    if (to_color) {
      png_set_strip_16(png_);
      png_set_strip_alpha(png_);
      png_set_palette_to_rgb(png_);
      isColor() ? png_set_bgr(png_) : png_set_gray_to_rgb(png_);
    } else {
      png_set_swap(png_);
    }
    if (!isColor()) {
      png_set_expand_gray_1_2_4_to_8(png_);
    }
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    png_read_image(png_, rows.data());
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  png_structp png_;
  png_infop info_;
};

tl::unexpected<Error> cannotDecode(const std::string& name, const Input& input) {
  return fail(name + " cannot be decoded: it is damaged (" + input.reason + ").");
}

Result<cv::Mat> readImage(PngDecoder& decoder, const Input& input, int type, const std::string& name) {
  cv::Mat image(decoder.size(), type);
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.rows; ++y) {
    rows.push_back(image.ptr(y));
  }
  if (!decoder.readRows(type == CV_8UC3, rows)) {
    return cannotDecode(name, input);
  }
  return image;
}

}  // namespace

Result<cv::Mat> decodeColorPng(std::span<const std::uint8_t> bytes, const std::string& name) {
  Input input{bytes};
  PngDecoder decoder(input);
  if (!decoder.readHeader()) {
    return cannotDecode(name, input);
  }
  return readImage(decoder, input, CV_8UC3, name);
}

Result<cv::Mat> decodeGreyPng(std::span<const std::uint8_t> bytes, const std::string& name) {
  Input input{bytes};
  PngDecoder decoder(input);
  if (!decoder.readHeader()) {
    return cannotDecode(name, input);
  }
  if (decoder.channels() != 1) {
    return fail(name + " is " + (decoder.is16Bit() ? "16-bit" : "8-bit") + " with " +
                    std::to_string(decoder.channels()) + " channels; depth images are 16-bit with 1 channel.",
                "Check that this is the depth folder and that the depth was saved as 16-bit PNG.");
  }
  return readImage(decoder, input, decoder.is16Bit() ? CV_16UC1 : CV_8UC1, name);
}

Result<cv::Mat> decodeAnyPng(std::span<const std::uint8_t> bytes, const std::string& name) {
  Input input{bytes};
  PngDecoder decoder(input);
  if (!decoder.readHeader()) {
    return cannotDecode(name, input);
  }
  const int grey = decoder.is16Bit() ? CV_16UC1 : CV_8UC1;
  return readImage(decoder, input, decoder.channels() == 1 ? grey : CV_8UC3, name);
}

}  // namespace scantrove
