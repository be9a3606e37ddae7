#include "core/fusion/packed_words.h"

#include <lz4.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <opencv2/core.hpp>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr std::size_t kWordBytes = sizeof(std::uint32_t);
/// LZ4 skips faster over incompressible data, such as the lowest bytes of distances.
constexpr int kAcceleration = 8;

/// The first byte of every word, then the second, ...
std::vector<char> toPlanes(std::span<const std::uint32_t> words) {
  static_assert(std::endian::native == std::endian::little);
  const int count = static_cast<int>(words.size());
  std::vector<char> planes(words.size_bytes());
  // OpenCV's split only reads its input.
  const cv::Mat whole(1, count, CV_8UC4, const_cast<std::uint32_t*>(words.data()));
  std::array<cv::Mat, kWordBytes> parts;
  for (std::size_t byte = 0; byte < kWordBytes; ++byte)
    parts[byte] = cv::Mat(1, count, CV_8UC1, planes.data() + byte * words.size());
  cv::split(whole, parts.data());
  return planes;
}

std::vector<std::uint32_t> fromPlanes(const std::vector<char>& planes) {
  const std::size_t count = planes.size() / kWordBytes;
  const auto byte = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(planes[i])}; };
  std::vector<std::uint32_t> words(count);
  for (std::size_t i = 0; i < count; ++i) {
    words[i] = byte(i) | byte(count + i) << 8U | byte(2 * count + i) << 16U | byte(3 * count + i) << 24U;
  }
  return words;
}

}  // namespace

std::uint64_t checksumOf(std::span<const char> bytes) {
  std::uint64_t sum = bytes.size();
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t count = std::min(bytes.size(), sizeof(word));
    std::memcpy(&word, bytes.data(), count);
    sum = (sum ^ word) * 0x9e3779b97f4a7c15ULL;
    sum ^= sum >> 29U;
    bytes = bytes.subspan(count);
  }
  return sum;
}

PackedWords packWords(std::span<const std::uint32_t> words) {
  SCANTROVE_CHECK(!words.empty() && words.size_bytes() < (1U << 30U));
  const std::vector<char> planes = toPlanes(words);
  const int size = static_cast<int>(planes.size());
  PackedWords packed;
  packed.bytes.resize(static_cast<std::size_t>(LZ4_compressBound(size)));
  const int used = LZ4_compress_fast(planes.data(), packed.bytes.data(), size,
                                     static_cast<int>(packed.bytes.size()), kAcceleration);
  SCANTROVE_CHECK(used > 0);
  packed.bytes.resize(static_cast<std::size_t>(used));
  packed.unpacked_bytes = static_cast<std::uint32_t>(size);
  packed.checksum = checksumOf(packed.bytes);
  return packed;
}

std::optional<std::vector<std::uint32_t>> unpackWords(const PackedWords& packed) {
  if (packed.unpacked_bytes % kWordBytes != 0 || packed.unpacked_bytes >= (1U << 30U) ||
      checksumOf(packed.bytes) != packed.checksum)
    return std::nullopt;
  std::vector<char> planes(packed.unpacked_bytes);
  const int size =
      LZ4_decompress_safe(packed.bytes.data(), planes.data(), static_cast<int>(packed.bytes.size()),
                          static_cast<int>(planes.size()));
  if (size != static_cast<int>(planes.size())) return std::nullopt;
  return fromPlanes(planes);
}

}  // namespace scantrove
