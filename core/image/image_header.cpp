#include "core/image/image_header.h"

#include <spng.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "core/image/file_bytes.h"
#include "core/image/jpeg_decoder.h"

namespace scantrove {

namespace {

using Bytes = std::span<const std::uint8_t>;

ImageSize pngSize(Bytes bytes) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> decoder(spng_ctx_new(0), &spng_ctx_free);
  spng_ihdr header{};
  const bool is_read = spng_set_png_buffer(decoder.get(), bytes.data(), bytes.size()) == 0 &&
                       spng_get_ihdr(decoder.get(), &header) == 0;
  return is_read ? ImageSize{header.width, header.height} : ImageSize{};
}

ImageSize jpegSize(Bytes bytes) {
  const JpegHeader header = readJpegHeader(bytes).value_or(JpegHeader{});
  return {static_cast<std::uint32_t>(header.size.width), static_cast<std::uint32_t>(header.size.height)};
}

struct PnmHeader {
  ImageSize size;
  std::uint32_t largest_value = 1;  ///< 1 for bitmaps, whose header has none
  std::uint64_t bytes = 0;          ///< size of the header, before the pixels
};

/// "P5", width, height and largest value, separated by blanks and lines of comment; one blank follows.
PnmHeader readPnmHeader(Bytes bytes) {
  std::string_view text = textOf(bytes).substr(2);
  const auto next = [&] {
    std::uint32_t value = 0;
    std::size_t begin = text.find_first_not_of(" \t\r\n");
    while (begin != std::string_view::npos && text[begin] == '#')
      begin = text.find_first_not_of(" \t\r\n", text.find('\n', begin));
    text.remove_prefix(std::min(begin, text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return error == std::errc() ? value : 0;
  };
  PnmHeader header;
  header.size.width = next();
  header.size.height = next();
  if (bytes[1] != '1' && bytes[1] != '4') header.largest_value = next();
  header.bytes = bytes.size() - text.size() + 1;
  return header;
}

/// The height is negative if rows run from top to bottom.
ImageSize bmpSize(Bytes bytes) {
  const auto number = [&](std::size_t at, std::size_t count) { return numberAt(bytes, at, count, false); };
  constexpr std::uint32_t kOldHeader = 12;
  if (number(14, 4) == kOldHeader) return {number(18, 2), number(20, 2)};
  const auto height = static_cast<std::int32_t>(number(22, 4));
  return {number(18, 4), static_cast<std::uint32_t>(std::abs(std::int64_t{height}))};
}

/// Reads tags 256 and 257 of the first directory, which may be anywhere in the file.
ImageSize tiffSize(Bytes bytes) {
  const auto number = [&](std::size_t at, std::size_t count) {
    return numberAt(bytes, at, count, bytes[0] == 'M');
  };
  const std::size_t directory = number(4, 4);
  ImageSize size;
  for (std::size_t i = 0; i < number(directory, 2); ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    const std::uint32_t value = number(entry + 8, number(entry + 2, 2) == 3 ? 2 : 4);  // a short or a long
    if (number(entry, 2) == 256) size.width = value;
    if (number(entry, 2) == 257) size.height = value;
  }
  return size;
}

ImageSize sizeOf(ImageFormat format, Bytes bytes) {
  switch (format) {
    case ImageFormat::png:
      return pngSize(bytes);
    case ImageFormat::jpeg:
      return jpegSize(bytes);
    case ImageFormat::pnm:
      return readPnmHeader(bytes).size;
    case ImageFormat::bmp:
      return bmpSize(bytes);
    case ImageFormat::tiff:
      return tiffSize(bytes);
  }
  return {};
}

}  // namespace

std::optional<ImageFormat> imageFormat(Bytes bytes) {
  using namespace std::string_view_literals;
  const std::string_view text = textOf(bytes);
  if (text.starts_with("\x89PNG\r\n\x1A\n")) return ImageFormat::png;
  if (text.starts_with("\xFF\xD8")) return ImageFormat::jpeg;
  if (text.starts_with("BM")) return ImageFormat::bmp;
  if (text.starts_with("II*\0"sv) || text.starts_with("MM\0*"sv)) return ImageFormat::tiff;
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') return ImageFormat::pnm;
  return std::nullopt;
}

std::optional<ImageSize> imageSize(Bytes bytes) {
  const auto format = imageFormat(bytes);
  if (!format) return std::nullopt;
  const ImageSize size = sizeOf(*format, bytes);
  return size.width > 0 && size.height > 0 ? std::optional(size) : std::nullopt;
}

std::uint64_t leastImageBytes(Bytes bytes) {
  const auto format = imageFormat(bytes);
  if (format == ImageFormat::bmp) return numberAt(bytes, 2, 4, false);
  if (format != ImageFormat::pnm || bytes[1] <= '3') return 0;
  const PnmHeader header = readPnmHeader(bytes);
  const std::uint64_t values = std::uint64_t{header.size.width} * (bytes[1] == '6' ? 3 : 1);
  const std::uint64_t row =
      bytes[1] == '4' ? (values + 7) / 8 : values * (header.largest_value > 255 ? 2 : 1);
  return header.bytes + row * header.size.height;
}

Result<void> checkImageSize(const ImageSize& size, const std::string& name) {
  if (std::uint64_t{size.width} * size.height <= kMaxImagePixels &&
      std::max(size.width, size.height) <= kLongestImageSide_px) {
    return {};
  }
  return fail(
      name + " has " + std::to_string(size.width) + "x" + std::to_string(size.height) + " pixels.",
      "Images of up to 4096x4096 pixels fit (16.8 million in all, no side above 8192): make them smaller; "
      "a scan works at a width of 320 pixels unless told otherwise.");
}

}  // namespace scantrove
