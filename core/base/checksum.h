#pragma once
#include <cstdint>
#include <span>

namespace scantrove {

/// CRC-32 (as in gzip) of `bytes`, continued from `crc`. Detects damage, not tampering.
[[nodiscard]] std::uint32_t crc32Of(std::span<const char> bytes, std::uint32_t crc = 0);

}  // namespace scantrove
