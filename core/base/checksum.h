#pragma once
#include <cstdint>
#include <span>

namespace scantrove {

/// CRC-32 (as of gzip) of `bytes`, continued from `crc`. Finds damage; no protection against intent.
[[nodiscard]] std::uint32_t crc32Of(std::span<const char> bytes, std::uint32_t crc = 0);

}  // namespace scantrove
