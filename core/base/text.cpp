#include "core/base/text.h"

#include <charconv>
#include <system_error>

namespace scantrove {

namespace {
constexpr std::string_view kBlanks = " \t\r\n\v\f";
constexpr std::string_view kSeparators = " \t\r\n\v\f,;";
}  // namespace

std::optional<std::vector<double>> parseNumbers(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t begin = text.find_first_not_of(kSeparators);
    if (begin == std::string_view::npos) {
      return numbers;
    }
    text.remove_prefix(begin);
    const std::string_view whole = text.substr(0, text.find_first_of(kSeparators));
    std::string_view word = whole;
    if (word.front() == '+') {  // from_chars takes no plus sign
      word.remove_prefix(1);
    }
    double value = 0;
    const auto [stopped, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stopped != word.data() + word.size()) {
      return std::nullopt;
    }
    numbers.push_back(value);
    text.remove_prefix(whole.size());
  }
}

std::vector<std::string_view> splitLines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') {
      line.remove_suffix(1);
    }
    lines.push_back(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) {
    return {};
  }
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::string forTerminal(std::string_view text, std::size_t longest) {
  const bool is_cut = text.size() > longest;
  if (is_cut) {
    while (longest > 0 && (static_cast<unsigned char>(text[longest]) & 0xC0U) == 0x80U) --longest;
    text = text.substr(0, longest);
  }
  std::string safe;
  safe.reserve(text.size() + 4);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const unsigned next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    const bool is_c1 = byte == 0xC2 && next >= 0x80 && next < 0xA0;  // U+0080 - U+009F in UTF-8
    if ((byte < 0x20 && byte != '\n') || byte == 0x7F || is_c1) {
      safe += '?';
      i += is_c1 ? 1 : 0;
    } else {
      safe += text[i];
    }
  }
  if (is_cut) safe += " ...";
  return safe;
}

std::optional<long> lastNumber(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t last = name.find_last_of(kDigits);
  if (last == std::string_view::npos) return std::nullopt;
  name = name.substr(0, last + 1);
  const std::size_t before = name.find_last_not_of(kDigits);
  if (before != std::string_view::npos) name.remove_prefix(before + 1);
  long number = 0;
  const auto parsed = std::from_chars(name.data(), name.data() + name.size(), number);
  return parsed.ec == std::errc{} ? std::optional(number) : std::nullopt;
}

std::optional<int> parseFrameNumber(std::string_view digits) {
  int number = 0;
  const auto [stopped, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (digits.empty() || digits.size() > 12 || digits.front() == '-' || error != std::errc() ||
      stopped != digits.data() + digits.size() || number > 999'999'999) {
    return std::nullopt;
  }
  return number;
}

}  // namespace scantrove
