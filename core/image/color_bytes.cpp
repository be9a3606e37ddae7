#include "core/image/color_bytes.h"

#include <libdeflate.h>
#include <spng.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string_view>

#include "core/image/file_bytes.h"
#include "core/image/image_header.h"
#include "core/image/jpeg_decoder.h"

namespace scantrove {

namespace {

using Bytes = std::span<const std::uint8_t>;
using MutableBytes = std::span<std::uint8_t>;

constexpr std::uint8_t kUpright = 1;

/// Sets the orientation in a TIFF directory (Exif) to upright. Returns whether it was another.
bool clearTiffOrientation(MutableBytes tiff) {
  constexpr std::uint32_t kOrientation = 0x0112;
  constexpr std::size_t kEntryBytes = 12;
  if (!textOf(tiff).starts_with("II") && !textOf(tiff).starts_with("MM")) return false;
  const bool is_big_endian = tiff[0] == 'M';
  const auto number = [&](std::size_t at, std::size_t count) {
    return numberAt(tiff, at, count, is_big_endian);
  };
  const std::size_t directory = number(4, 4);
  constexpr std::size_t kHeaderBytes = 8;
  if (directory < kHeaderBytes) return false;
  bool is_changed = false;
  for (std::size_t i = 0; i < number(directory, 2); ++i) {
    const std::size_t entry = directory + 2 + i * kEntryBytes;
    if (entry > tiff.size() || tiff.size() - entry < kEntryBytes) break;
    if (number(entry, 2) != kOrientation) continue;
    const std::uint32_t type = number(entry + 2, 2);  // a byte, a short, a long
    const std::size_t bytes = type == 1 ? 1 : type == 4 ? 4 : 2;
    const std::size_t value = entry + 8;
    if (number(value, bytes) == kUpright) continue;
    std::fill_n(tiff.begin() + static_cast<std::ptrdiff_t>(value), bytes, std::uint8_t{0});
    tiff[is_big_endian ? value + bytes - 1 : value] = kUpright;
    is_changed = true;
  }
  return is_changed;
}

/// The same for XMP: `tiff:Orientation="6"`, or `<tiff:Orientation>6<`.
bool clearXmpOrientation(MutableBytes xmp) {
  constexpr std::string_view kName = "tiff:Orientation";
  const std::string_view text = textOf(xmp);
  bool is_changed = false;
  for (std::size_t at = text.find(kName); at != std::string_view::npos; at = text.find(kName, at + 1)) {
    const std::size_t digit = text.find_first_not_of(" \t\r\n=\"'>", at + kName.size());
    if (digit == std::string_view::npos || text[digit] < '2' || text[digit] > '8') continue;
    xmp[digit] = '1';
    is_changed = true;
  }
  return is_changed;
}

/// Processes the segments before the pixels.
void clearJpegOrientation(MutableBytes jpeg) {
  constexpr std::uint8_t kMarker = 0xFF, kApplication1 = 0xE1, kStartOfScan = 0xDA;
  constexpr std::string_view kExif{"Exif\0", 5};
  constexpr std::size_t kExifHeader = 6;
  std::size_t at = 2;
  while (jpeg.size() >= at + 4 && jpeg[at] == kMarker && jpeg[at + 1] != kStartOfScan) {
    if (jpeg[at + 1] == kMarker) {  // fill byte
      ++at;
      continue;
    }
    const std::size_t length = numberAt(jpeg, at + 2, 2, true);
    if (length < 2 || length > jpeg.size() - at - 2) return;
    const MutableBytes content = jpeg.subspan(at + 4, length - 2);
    if (jpeg[at + 1] == kApplication1) {
      if (textOf(content).starts_with(kExif) && content.size() > kExifHeader) {
        clearTiffOrientation(content.subspan(kExifHeader));
      } else {
        clearXmpOrientation(content);
      }
    }
    at += 2 + length;
  }
}

/// Metadata whose orientation cannot simply be replaced, because it is compressed or stored as digits.
bool isHiddenMetadata(Bytes content) {
  using namespace std::string_view_literals;
  constexpr std::array kNames{"Raw profile type exif\0"sv, "Raw profile type APP1\0"sv,
                              "Raw profile type xmp\0"sv, "XML:com.adobe.xmp\0\1"sv};
  return std::any_of(kNames.begin(), kNames.end(),
                     [&](std::string_view name) { return textOf(content).starts_with(name); });
}

std::string clearPngOrientation(std::string& png) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // length, type, checksum
  const MutableBytes bytes(reinterpret_cast<std::uint8_t*>(png.data()), png.size());
  std::string kept = png.substr(0, kSignature);
  std::size_t at = kSignature;
  while (bytes.size() >= at + kFrame) {
    const std::size_t length = numberAt(bytes, at, 4, true);
    if (length > bytes.size() - at - kFrame) break;
    const MutableBytes typed = bytes.subspan(at + 4, length + 4);
    const MutableBytes content = typed.subspan(4);
    const bool is_text = textOf(typed).starts_with("tEXt") || textOf(typed).starts_with("zTXt") ||
                         textOf(typed).starts_with("iTXt");
    const bool is_changed = (textOf(typed).starts_with("eXIf") && clearTiffOrientation(content)) ||
                            (textOf(typed).starts_with("iTXt") && clearXmpOrientation(content));
    if (is_changed) {
      const std::uint32_t sum = libdeflate_crc32(0, typed.data(), typed.size());
      for (std::size_t i = 0; i < 4; ++i)
        bytes[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    }
    if (!is_text || !isHiddenMetadata(content)) kept.append(png, at, kFrame + length);
    at += kFrame + length;
  }
  return kept.append(png, at);
}

/// Whether none of its colours is declared transparent.
bool isPlainPng(Bytes png) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> decoder(spng_ctx_new(0), &spng_ctx_free);
  spng_ihdr header{};
  spng_trns transparency{};
  return spng_set_png_buffer(decoder.get(), png.data(), png.size()) == 0 &&
         spng_get_ihdr(decoder.get(), &header) == 0 && header.bit_depth == 8 &&
         header.color_type == SPNG_COLOR_TYPE_TRUECOLOR &&
         spng_get_trns(decoder.get(), &transparency) == SPNG_ECHUNKAVAIL;
}

}  // namespace

bool isPlainColor(Bytes bytes) {
  const auto format = imageFormat(bytes);
  if (format == ImageFormat::jpeg) {
    const auto header = readJpegHeader(bytes);
    return header && header->is_color;
  }
  return format == ImageFormat::png && isPlainPng(bytes);
}

std::string withoutOrientation(std::string bytes) {
  const auto data = MutableBytes(reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size());
  const auto format = imageFormat(data);
  if (format == ImageFormat::png) return clearPngOrientation(bytes);
  if (format == ImageFormat::jpeg) clearJpegOrientation(data);
  return bytes;
}

}  // namespace scantrove
