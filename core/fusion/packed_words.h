#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace scantrove {

/// Compressed 32-bit words of the map: bytes of equal significance are grouped, then compressed with LZ4. Any
/// thread.
struct PackedWords {
  std::vector<char> bytes;
  std::uint32_t unpacked_bytes = 0;
  std::uint64_t checksum = 0;  ///< of `bytes`
};

/// `words`: less than 1 GiB, not empty.
[[nodiscard]] PackedWords packWords(std::span<const std::uint32_t> words);

/// None if the bytes are damaged.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> unpackWords(const PackedWords& packed);

/// Detects damage; no protection against deliberate changes.
[[nodiscard]] std::uint64_t checksumOf(std::span<const char> bytes);

}  // namespace scantrove
