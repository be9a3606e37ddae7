#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace scantrove {

/// Words as metadata of a session: compressed, with a checksum, in base64. Any thread.
[[nodiscard]] std::string packedText(std::span<const std::uint32_t> words);
/// None: malformed text.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> wordsFromText(const std::string& text);

}  // namespace scantrove
