#include "core/image/jpeg_decoder.h"

#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <string_view>
#include <type_traits>

#include "core/image/file_bytes.h"

namespace scantrove {

namespace {

using Bytes = std::span<const std::uint8_t>;
using Decoder = std::unique_ptr<std::remove_pointer_t<tjhandle>, decltype(&tjDestroy)>;

std::optional<JpegHeader> readHeader(tjhandle decoder, Bytes bytes) {
  int width = 0, height = 0, subsampling = 0, colors = -1;
  // The function also fails if only the subsampling is unknown.
  tjDecompressHeader3(decoder, bytes.data(), static_cast<unsigned long>(bytes.size()), &width, &height,
                      &subsampling, &colors);
  if (colors < 0) return std::nullopt;
  return JpegHeader{{width, height},
                    colors == TJCS_RGB || colors == TJCS_YCbCr,
                    colors == TJCS_CMYK || colors == TJCS_YCCK};
}

/// Warnings that leave the pixels intact.
bool isHarmless(std::string_view warning) {
  constexpr std::array kTexts{"extraneous bytes before marker", "too many scanlines", "Adobe color transform",
                              "Inconsistent progression sequence"};
  return std::any_of(kTexts.begin(), kTexts.end(),
                     [&](std::string_view text) { return warning.find(text) != std::string_view::npos; });
}

/// Whether an end marker follows the last start of pixels, because TurboJPEG reports only the first of
/// several warnings.
bool isEnded(Bytes jpeg) {
  const std::size_t end = textOf(jpeg).rfind("\xFF\xD9");
  return end != std::string_view::npos && end > textOf(jpeg).rfind("\xFF\xDA");
}

/// Whether the file has Adobe's marker: CMYK is then stored inverted. Compressed pixels cannot contain its
/// bytes.
bool isByAdobe(Bytes jpeg) {
  using namespace std::string_view_literals;
  return textOf(jpeg).find("\xFF\xEE\0\016Adobe"sv) != std::string_view::npos;
}

cv::Mat cmykToBgr(const cv::Mat& cmyk, bool is_light) {
  cv::Mat bgr(cmyk.size(), CV_8UC3);
  for (int y = 0; y < cmyk.rows; ++y) {
    for (int x = 0; x < cmyk.cols; ++x) {
      const auto& ink = cmyk.at<cv::Vec4b>(y, x);
      const auto light = [&](int channel) { return is_light ? ink[channel] : 255 - ink[channel]; };
      for (int channel = 0; channel < 3; ++channel)
        bgr.at<cv::Vec3b>(y, x)[2 - channel] =
            static_cast<std::uint8_t>((light(channel) * light(3) + 127) / 255);
    }
  }
  return bgr;
}

/// Pixels as TurboJPEG returns them: BGR or CMYK. Error: its reason; empty if the file is truncated.
tl::expected<cv::Mat, std::string> decode(Bytes bytes) {
  const Decoder decoder(tjInitDecompress(), &tjDestroy);
  const auto header = readHeader(decoder.get(), bytes);
  if (!header) return tl::unexpected<std::string>(tjGetErrorStr2(decoder.get()));
  cv::Mat image(header->size, header->is_cmyk ? CV_8UC4 : CV_8UC3);
  if (tjDecompress2(decoder.get(), bytes.data(), static_cast<unsigned long>(bytes.size()), image.data,
                    image.cols, 0, image.rows, header->is_cmyk ? TJPF_CMYK : TJPF_BGR,
                    TJFLAG_LIMITSCANS) == 0)
    return image;
  const std::string reason = tjGetErrorStr2(decoder.get());
  if (!isEnded(bytes)) return tl::unexpected<std::string>("");
  if (tjGetErrorCode(decoder.get()) == TJERR_WARNING && isHarmless(reason)) return image;
  return tl::unexpected(reason);
}

}  // namespace

std::optional<JpegHeader> readJpegHeader(Bytes bytes) {
  const Decoder decoder(tjInitDecompress(), &tjDestroy);
  return readHeader(decoder.get(), bytes);
}

Result<cv::Mat> decodeJpeg(Bytes bytes, const std::string& name) {
  const auto image = decode(bytes);
  if (!image && image.error().empty())
    return fail(name + " is truncated (" + std::to_string(bytes.size()) + " bytes).");
  if (!image) return fail(name + " cannot be decoded: it is damaged (" + image.error() + ").");
  return image->channels() == 4 ? cmykToBgr(*image, isByAdobe(bytes)) : *image;
}

}  // namespace scantrove
