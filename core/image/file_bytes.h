#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace scantrove {

/// The bytes as text, for searching and comparing.
[[nodiscard]] inline std::string_view textOf(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A number of `count` bytes, at most 4, at any offset; 0 beyond the end.
[[nodiscard]] inline std::uint32_t numberAt(std::span<const std::uint8_t> bytes, std::size_t at,
                                            std::size_t count, bool is_big_endian) {
  std::uint32_t value = 0;
  if (at > bytes.size() || count > bytes.size() - at) return 0;
  for (std::size_t i = 0; i < count; ++i)
    value = value << 8 | bytes[at + (is_big_endian ? i : count - 1 - i)];
  return value;
}

}  // namespace scantrove
