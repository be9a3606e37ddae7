#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace scantrove {

/// Words as a fact of a session keeps them: packed, checked, and as base64. Any thread.
[[nodiscard]] std::string packedText(std::span<const std::uint32_t> words);
/// None: the text is not what was packed.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> wordsFromText(const std::string& text);

}  // namespace scantrove
