#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scantrove {

/// Parses numbers separated by blanks or commas ("nan" and "inf" included), in any locale; empty if something
/// is no number.
[[nodiscard]] std::optional<std::vector<double>> parseNumbers(std::string_view text);

/// The lines of a text, without line ends.
[[nodiscard]] std::vector<std::string_view> splitLines(std::string_view text);

/// `text` without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// `text` for a terminal: control characters except line feeds become '?'. Text of over `longest` bytes is
/// cut between UTF-8 characters and ends in "...".
[[nodiscard]] std::string forTerminal(std::string_view text, std::size_t longest = 2000);

/// The last number in `name`: 12 of "img-7-frame-000012.color". Empty: none, or it is too large.
[[nodiscard]] std::optional<long> lastNumber(std::string_view name);

/// `digits` as a non-negative number below 10^9; empty otherwise.
[[nodiscard]] std::optional<int> parseFrameNumber(std::string_view digits);

}  // namespace scantrove
