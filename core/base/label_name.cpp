#include "core/base/label_name.h"

#include <algorithm>
#include <optional>

namespace scantrove {
namespace {

/// Decodes strict UTF-8: no overlong forms, no surrogates, nothing above U+10FFFF.
std::optional<std::u32string> decodeUtf8(std::string_view text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    if (length == 0 || first > 0xF4 || i + length > text.size()) return std::nullopt;
    char32_t point = length == 1 ? first : first & (0x7FU >> length);
    for (std::size_t k = 1; k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xC0U) != 0x80U) return std::nullopt;
      point = point << 6U | (next & 0x3FU);
    }
    const bool is_overlong = (length == 3 && point < 0x800) || (length == 4 && point < 0x10000);
    if (is_overlong || point > 0x10FFFF || (point >= 0xD800 && point < 0xE000)) return std::nullopt;
    points += point;
    i += length;
  }
  return points;
}

std::string encodeUtf8(std::u32string_view points) {
  std::string text;
  for (const char32_t point : points) {
    if (point < 0x80) {
      text += static_cast<char>(point);
      continue;
    }
    const unsigned tail = point < 0x800 ? 1 : point < 0x10000 ? 2 : 3;
    const unsigned mark = (0xFF00U >> (tail + 1)) & 0xFFU;  // 0xC0, 0xE0 or 0xF0
    text += static_cast<char>(mark | (point >> (6U * tail)));
    for (unsigned k = tail; k-- > 0;) text += static_cast<char>(0x80U | ((point >> (6U * k)) & 0x3FU));
  }
  return text;
}

bool isBlank(char32_t c) {
  return (c >= 0x09 && c <= 0x0D) || c == 0x20 || c == 0x85 || c == 0xA0 || c == 0x1680 ||
         (c >= 0x2000 && c <= 0x200A) || c == 0x2028 || c == 0x2029 || c == 0x202F || c == 0x205F ||
         c == 0x3000;
}

bool isControl(char32_t c) { return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x2028 || c == 0x2029; }

bool isDigit(char32_t c) { return c >= U'0' && c <= U'9'; }

/// Applies the rules shared by names and categories. The result may be empty.
Result<std::u32string> trimmedLine(std::string_view text, const std::string& kind) {
  const std::optional<std::u32string> points = decodeUtf8(text);
  if (!points) return fail("The " + kind + " is not UTF-8 text.", "Type it again.");
  const auto begin = std::ranges::find_if_not(*points, isBlank);
  const auto end = std::find_if_not(points->rbegin(), points->rend(), isBlank).base();
  const std::u32string line = begin < end ? std::u32string(begin, end) : std::u32string();
  if (std::ranges::any_of(line, isControl)) {
    return fail("A " + kind + " cannot have line breaks, tabs or other control characters in it.",
                "Type it in one line.");
  }
  if (line.size() > kLongestLabelName) {
    return fail("The " + kind + " is " + std::to_string(line.size()) + " characters long.",
                "Use at most " + std::to_string(kLongestLabelName) + ".");
  }
  return line;
}

}  // namespace

Result<std::string> checkedLabelName(std::string_view name) {
  const Result<std::u32string> line = trimmedLine(name, "name");
  if (!line) return fail(line.error());
  std::string text = encodeUtf8(*line);
  if (text.empty()) return fail("An object needs a name.", "Type one.");
  if (std::ranges::all_of(*line, isDigit)) {
    return fail("'" + text + "' cannot be a name: a number alone stands for an object's id.",
                "Add a letter, as in 'mug " + text + "'.");
  }
  return text;
}

Result<std::string> checkedCategoryName(std::string_view category) {
  const Result<std::u32string> line = trimmedLine(category, "category");
  if (!line) return fail(line.error());
  return encodeUtf8(*line);
}

Result<std::string> checkedProjectName(std::string_view name) {
  const Result<std::u32string> line = trimmedLine(name, "name of the project");
  if (!line) return fail(line.error());
  return encodeUtf8(*line);
}

}  // namespace scantrove
