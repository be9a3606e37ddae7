#include "core/image/png_encoder.h"

#include <spng.h>
#include <zlib.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "core/base/check.h"
#include "core/image/image_header.h"

namespace scantrove {
namespace {

void require(int error) {
  if (error != 0)
    throw std::runtime_error(std::string("an image could not be encoded (") + spng_strerror(error) + ")");
}

/// Pixels without row padding, in a PNG's channel order.
cv::Mat asStored(const cv::Mat& image) {
  cv::Mat stored;
  if (image.channels() == 3) {
    cv::cvtColor(image, stored, cv::COLOR_BGR2RGB);
  } else {
    stored = image.isContinuous() ? image : image.clone();
  }
  return stored;
}

using Encoder = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

/// The PNG of `pixels`, whose rows have no padding. `palette`: none, or its colours.
std::string encodePixels(const cv::Mat& pixels, std::uint8_t color_type, const spng_plte* palette) {
  const ImageSize size{static_cast<std::uint32_t>(pixels.cols), static_cast<std::uint32_t>(pixels.rows)};
  if (const Result<void> fits = checkImageSize(size, "An image"); !fits)
    throw std::runtime_error(fits.error().message());
  const Encoder encoder(spng_ctx_new(SPNG_CTX_ENCODER), &spng_ctx_free);
  spng_ihdr header{};
  header.width = size.width;
  header.height = size.height;
  header.bit_depth = pixels.depth() == CV_16U ? 16 : 8;
  header.color_type = color_type;
  require(spng_set_ihdr(encoder.get(), &header));
  if (palette != nullptr) {
    spng_plte copy = *palette;
    require(spng_set_plte(encoder.get(), &copy));
  }
  require(spng_set_option(encoder.get(), SPNG_ENCODE_TO_BUFFER, 1));
  require(spng_set_option(encoder.get(), SPNG_IMG_COMPRESSION_LEVEL, 1));
  require(spng_set_option(encoder.get(), SPNG_IMG_COMPRESSION_STRATEGY, Z_RLE));
  require(spng_set_option(encoder.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_UP));
  require(spng_encode_image(encoder.get(), pixels.data, pixels.total() * pixels.elemSize(), SPNG_FMT_PNG,
                            SPNG_ENCODE_FINALIZE));
  std::size_t bytes = 0;
  int error = 0;
  const std::unique_ptr<void, decltype(&std::free)> png(spng_get_png_buffer(encoder.get(), &bytes, &error),
                                                        &std::free);
  require(error);
  return {static_cast<const char*>(png.get()), bytes};
}

}  // namespace

std::string encodePng(const cv::Mat& image) {
  SCANTROVE_CHECK((image.type() == CV_16UC1 || image.type() == CV_8UC1 || image.type() == CV_8UC3) &&
                  !image.empty());
  const auto type = image.channels() == 1 ? SPNG_COLOR_TYPE_GRAYSCALE : SPNG_COLOR_TYPE_TRUECOLOR;
  return encodePixels(asStored(image), static_cast<std::uint8_t>(type), nullptr);
}

std::string encodePalettePng(const cv::Mat& indices, std::span<const std::array<std::uint8_t, 3>> palette) {
  constexpr std::size_t kMaxColors = 256;
  SCANTROVE_CHECK(indices.type() == CV_8UC1 && !indices.empty());
  SCANTROVE_CHECK(!palette.empty() && palette.size() <= kMaxColors);
  spng_plte colors{};
  colors.n_entries = static_cast<std::uint32_t>(palette.size());
  for (std::size_t i = 0; i < palette.size(); ++i)
    colors.entries[i] = {palette[i][0], palette[i][1], palette[i][2], 255};
  return encodePixels(asStored(indices), SPNG_COLOR_TYPE_INDEXED, &colors);
}

}  // namespace scantrove
