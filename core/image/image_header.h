#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Supported image formats.
enum class ImageFormat { png, jpeg, pnm, bmp, tiff };

/// Bytes at the start of a file that usually contain the header (in a JPEG, a thumbnail may precede it).
inline constexpr std::size_t kImageHeaderBytes = 1 << 16;

/// Maximum pixels and longest side of images: beyond any depth camera, and decoded in well under a second.
inline constexpr std::uint64_t kMaxImagePixels = std::uint64_t{4096} * 4096;
inline constexpr std::uint32_t kLongestImageSide_px = 8192;

struct ImageSize {
  std::uint32_t width = 0, height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// The format according to a file's first bytes; empty if unsupported.
[[nodiscard]] std::optional<ImageFormat> imageFormat(std::span<const std::uint8_t> bytes);

/// The size in an image's header, without decoding; empty if the header is incomplete or invalid. PNM, BMP
/// and TIFF are parsed here because OpenCV, which decodes them, allocates any size a header claims, up to
/// three gigabytes. A program cannot set its limits.
[[nodiscard]] std::optional<ImageSize> imageSize(std::span<const std::uint8_t> bytes);

/// Minimum bytes of a PNM or BMP according to its header; 0 for other formats and PNM as text.
[[nodiscard]] std::uint64_t leastImageBytes(std::span<const std::uint8_t> bytes);

/// Error: the image `name` is empty or exceeds the limits; names them.
[[nodiscard]] Result<void> checkImageSize(const ImageSize& size, const std::string& name);

}  // namespace scantrove
