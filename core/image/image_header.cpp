#include "core/image/image_header.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

namespace scantrove {

namespace {

using Bytes = std::span<const std::uint8_t>;

/// Numbers of `count` bytes at any place of a file; 0 beyond its end.
class Numbers {
 public:
  Numbers(Bytes bytes, bool is_big_endian) : bytes_(bytes), is_big_endian_(is_big_endian) {}

  [[nodiscard]] std::uint32_t at(std::size_t position, std::size_t count) const {
    std::uint32_t value = 0;
    if (position > bytes_.size() || count > bytes_.size() - position) {
      return 0;
    }
    for (std::size_t i = 0; i < count; ++i) {
      value = value << 8 | bytes_[position + (is_big_endian_ ? i : count - 1 - i)];
    }
    return value;
  }

 private:
  Bytes bytes_;
  bool is_big_endian_;
};

bool startsWith(Bytes bytes, std::string_view start) {
  return bytes.size() >= start.size() &&
         std::equal(start.begin(), start.end(), bytes.begin(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

ImageSize pngSize(Bytes bytes) {
  const Numbers numbers(bytes, true);
  return {numbers.at(16, 4), numbers.at(20, 4)};
}

/// In the frame header (SOF0 to SOF15 but for the tables DHT, JPG and DAC), which the other segments precede.
ImageSize jpegSize(Bytes bytes) {
  const Numbers numbers(bytes, true);
  std::size_t at = 2;
  while (numbers.at(at, 1) == 0xFF) {
    const std::uint32_t type = numbers.at(at + 1, 1);
    if (type == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    if (type >= 0xC0 && type <= 0xCF && type != 0xC4 && type != 0xC8 && type != 0xCC) {
      return {numbers.at(at + 7, 2), numbers.at(at + 5, 2)};
    }
    at += 2 + numbers.at(at + 2, 2);
  }
  return {};
}

struct PnmHeader {
  ImageSize size;
  std::uint32_t largest_value = 1;  ///< P1 and P4 (bits) have none
  std::size_t bytes = 0;            ///< of the header; the pixels follow
};

/// "P5", width, height, largest value, separated by blanks and lines of comment; one blank before the pixels.
PnmHeader readPnmHeader(Bytes bytes) {
  const std::string_view whole(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::string_view text = whole.substr(2);
  const auto next = [&] {
    std::uint32_t value = 0;
    std::size_t begin = text.find_first_not_of(" \t\r\n");
    while (begin != std::string_view::npos && text[begin] == '#') {
      begin = text.find_first_not_of(" \t\r\n", text.find('\n', begin));
    }
    text.remove_prefix(std::min(begin, text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return error == std::errc() ? value : 0;
  };
  PnmHeader header;
  header.size.width = next();
  header.size.height = next();
  if (whole[1] != '1' && whole[1] != '4') {
    header.largest_value = next();
  }
  header.bytes = whole.size() - text.size() + 1;
  return header;
}

/// Of a binary PNM: its header and pixels.
std::uint64_t pnmBytes(Bytes bytes) {
  const PnmHeader header = readPnmHeader(bytes);
  const std::uint64_t width = header.size.width;
  const std::uint64_t bytes_of_value = header.largest_value > 255 ? 2 : 1;
  switch (bytes[1]) {
    case '4':
      return header.bytes + (width + 7) / 8 * header.size.height;
    case '5':
      return header.bytes + width * header.size.height * bytes_of_value;
    case '6':
      return header.bytes + width * header.size.height * bytes_of_value * 3;
    default:
      return header.bytes;
  }
}

/// The height is negative where rows run from the top.
ImageSize bmpSize(Bytes bytes) {
  const Numbers numbers(bytes, false);
  constexpr std::uint32_t kOldHeader = 12;
  if (numbers.at(14, 4) == kOldHeader) {
    return {numbers.at(18, 2), numbers.at(20, 2)};
  }
  const auto height = static_cast<std::int32_t>(numbers.at(22, 4));
  return {numbers.at(18, 4), static_cast<std::uint32_t>(std::abs(std::int64_t{height}))};
}

/// Tags 256 and 257 of the first directory, which may lie anywhere in the file.
ImageSize tiffSize(Bytes bytes) {
  const Numbers numbers(bytes, bytes[0] == 'M');
  const std::size_t directory = numbers.at(4, 4);
  ImageSize size;
  for (std::size_t i = 0; i < numbers.at(directory, 2); ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    const std::size_t bytes_of_value = numbers.at(entry + 2, 2) == 3 ? 2 : 4;  // a short or a long
    const std::uint32_t value = numbers.at(entry + 8, bytes_of_value);
    if (numbers.at(entry, 2) == 256) size.width = value;
    if (numbers.at(entry, 2) == 257) size.height = value;
  }
  return size;
}

}  // namespace

std::optional<ImageFormat> imageFormat(Bytes bytes) {
  using namespace std::string_view_literals;
  if (startsWith(bytes, "\x89PNG\r\n\x1A\n")) return ImageFormat::png;
  if (startsWith(bytes, "\xFF\xD8")) return ImageFormat::jpeg;
  if (startsWith(bytes, "BM")) return ImageFormat::bmp;
  if (startsWith(bytes, "II*\0"sv) || startsWith(bytes, "MM\0*"sv)) return ImageFormat::tiff;
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') return ImageFormat::pnm;
  return std::nullopt;
}

std::optional<ImageSize> imageSize(Bytes bytes) {
  const auto format = imageFormat(bytes);
  if (!format) {
    return std::nullopt;
  }
  ImageSize size;
  switch (*format) {
    case ImageFormat::png:
      size = pngSize(bytes);
      break;
    case ImageFormat::jpeg:
      size = jpegSize(bytes);
      break;
    case ImageFormat::pnm:
      size = readPnmHeader(bytes).size;
      break;
    case ImageFormat::bmp:
      size = bmpSize(bytes);
      break;
    case ImageFormat::tiff:
      size = tiffSize(bytes);
      break;
  }
  return size.width > 0 && size.height > 0 ? std::optional(size) : std::nullopt;
}

std::uint64_t leastImageBytes(Bytes bytes) {
  const auto format = imageFormat(bytes);
  if (format == ImageFormat::pnm) return pnmBytes(bytes);
  return format == ImageFormat::bmp ? Numbers(bytes, false).at(2, 4) : 0;
}

Result<void> checkImageSize(const ImageSize& size, const std::string& name) {
  if (std::uint64_t{size.width} * size.height <= kMostImagePixels &&
      std::max(size.width, size.height) <= kLongestImageSide_px) {
    return {};
  }
  return fail(
      name + " has " + std::to_string(size.width) + "x" + std::to_string(size.height) + " pixels.",
      "Images of up to 4096x4096 pixels fit (16.8 million in all, no side above 8192): make them smaller; "
      "a scan works at a width of 320 pixels unless told otherwise.");
}

}  // namespace scantrove
