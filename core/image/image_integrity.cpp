#include "core/image/image_integrity.h"

#include <algorithm>
#include <array>

#include "core/image/image_header.h"

namespace scantrove {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::uint8_t kMarker = 0xFF;
constexpr std::uint8_t kStartOfImage = 0xD8;
constexpr std::uint8_t kStartOfScan = 0xDA;
constexpr std::uint8_t kEndOfImage = 0xD9;

std::string truncated(Bytes bytes) { return "is truncated (" + std::to_string(bytes.size()) + " bytes)"; }

/// Chunks are length (big endian), type, data, checksum.
bool reachesPngEnd(Bytes bytes) {
  constexpr std::size_t kFrameBytes = 12;
  constexpr std::array<std::uint8_t, 4> kEnd = {'I', 'E', 'N', 'D'};
  std::size_t at = kPngSignature.size();
  while (bytes.size() >= at + kFrameBytes) {
    const std::size_t length = std::size_t{bytes[at]} << 24 | std::size_t{bytes[at + 1]} << 16 |
                               std::size_t{bytes[at + 2]} << 8 | std::size_t{bytes[at + 3]};
    if (std::equal(kEnd.begin(), kEnd.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at + 4))) {
      return true;
    }
    at += kFrameBytes + length;
  }
  return false;
}

/// Segments are 0xFF, type, length (big endian, counts itself), up to the scan. In the scan's own data 0xFF
/// is always followed by 0 or a restart marker, so the first 0xFF 0xD9 there is the end.
bool reachesJpegEnd(Bytes bytes) {
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == kMarker) {
    const std::uint8_t type = bytes[at + 1];
    if (type == kMarker) {  // fill byte
      ++at;
      continue;
    }
    at += 2 + (std::size_t{bytes[at + 2]} << 8 | std::size_t{bytes[at + 3]});
    if (type == kStartOfScan) {
      break;
    }
  }
  if (at >= bytes.size()) {
    return false;
  }
  constexpr std::array<std::uint8_t, 2> kEnd = {kMarker, kEndOfImage};
  // From the back: the end marker is nearly always the last thing in the file.
  const auto scan = bytes.subspan(at);
  return std::find_end(scan.begin(), scan.end(), kEnd.begin(), kEnd.end()) != scan.end();
}

}  // namespace

std::string findImageDamage(Bytes bytes) {
  if (bytes.empty()) {
    return "is empty";
  }
  const std::size_t compared = std::min(bytes.size(), kPngSignature.size());
  if (std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(compared),
                 kPngSignature.begin())) {
    return reachesPngEnd(bytes) ? "" : truncated(bytes);
  }
  if (bytes[0] == kMarker && (bytes.size() == 1 || bytes[1] == kStartOfImage)) {
    return reachesJpegEnd(bytes) ? "" : truncated(bytes);
  }
  return leastImageBytes(bytes) <= bytes.size() ? "" : truncated(bytes);
}

}  // namespace scantrove
