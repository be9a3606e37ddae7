#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// The formats of images that are read.
enum class ImageFormat { png, jpeg, pnm, bmp, tiff };

/// Bytes at the start of a file in which the header usually lies (a JPEG may carry a thumbnail before it).
inline constexpr std::size_t kImageHeaderBytes = 1 << 16;

/// The most pixels of an image that is read, and the longest side: beyond any depth camera, and decoded in
/// well under a second.
inline constexpr std::uint64_t kMaxImagePixels = std::uint64_t{4096} * 4096;
inline constexpr std::uint32_t kLongestImageSide_px = 8192;

struct ImageSize {
  std::uint32_t width = 0, height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// The format that the first bytes of a file tell; empty if it is none of ours.
[[nodiscard]] std::optional<ImageFormat> imageFormat(std::span<const std::uint8_t> bytes);

/// The size that an image's header tells, without decoding; empty if the header is not among the bytes or
/// makes no sense. PNM, BMP and TIFF are parsed here: OpenCV, which decodes them, allocates what a header
/// claims, up to three gigabytes, and its limits cannot be set by a program.
[[nodiscard]] std::optional<ImageSize> imageSize(std::span<const std::uint8_t> bytes);

/// The bytes that a PNM or BMP has at least by its header; 0 for other formats and PNM as text.
[[nodiscard]] std::uint64_t leastImageBytes(std::span<const std::uint8_t> bytes);

/// Error: the image `name` is empty or larger than what is read; says what fits.
[[nodiscard]] Result<void> checkImageSize(const ImageSize& size, const std::string& name);

}  // namespace scantrove
