#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "core/capture/containers/byte_cursor.h"

// The element structure of Matroska (RFC 8794): an id, a size, and data, which may be elements again.
namespace scantrove::ebml {

inline constexpr std::uint64_t kUnknownSize = ~std::uint64_t{0};

/// A number whose leading zero bits tell its length, 1 to 8 bytes. `keeps_marker`: as ids are written. None:
/// cut, or no such number. A size of all ones is kUnknownSize.
inline std::optional<std::uint64_t> readNumber(ByteCursor& cursor, bool keeps_marker) {
  const auto first = cursor.get<std::uint8_t>();
  if (!cursor.isOk() || first == 0) return std::nullopt;
  const int length = std::countl_zero(first) + 1;
  const auto marker = static_cast<std::uint8_t>(0x80U >> (length - 1));
  std::uint64_t value = keeps_marker ? first : first & (marker - 1U);
  bool is_all_ones = (first & (marker - 1U)) == marker - 1U;
  for (int i = 1; i < length; ++i) {
    const auto next = cursor.get<std::uint8_t>();
    value = value << 8 | next;
    is_all_ones = is_all_ones && next == 0xFF;
  }
  if (!cursor.isOk()) return std::nullopt;
  return !keeps_marker && is_all_ones ? kUnknownSize : value;
}

/// An element inside of bytes that are in memory.
struct Child {
  std::uint32_t id = 0;
  ByteView data;

  /// Big-endian, of up to 8 bytes.
  [[nodiscard]] std::uint64_t number() const {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : data.first(std::min<std::size_t>(data.size(), 8)))
      value = value << 8 | byte;
    return value;
  }
  /// Up to a zero byte.
  [[nodiscard]] std::string text() const {
    const std::string all(reinterpret_cast<const char*>(data.data()), data.size());
    return all.substr(0, all.find('\0'));
  }
};

/// Calls `use(child)` for the elements in `bytes`; stops at one that is cut.
template <class Use>
void forEachChild(ByteView bytes, const Use& use) {
  ByteCursor cursor(bytes);
  while (cursor.left() > 0) {
    const auto id = readNumber(cursor, true);
    const auto size = id ? readNumber(cursor, false) : std::nullopt;
    if (!size || *id > 0xFFFFFFFFU || *size > cursor.left()) return;
    use(Child{static_cast<std::uint32_t>(*id), cursor.take(*size)});
  }
}

}  // namespace scantrove::ebml
