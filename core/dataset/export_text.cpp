#include "core/dataset/export_text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <vector>

namespace scantrove {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

/// The character at `at`, which is advanced; an invalid byte is U+FFFD.
char32_t nextCharacter(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(at);
  const std::size_t length = first < 0x80U        ? 1
                             : first >> 5U == 6U  ? 2
                             : first >> 4U == 14U ? 3
                             : first >> 3U == 30U ? 4
                                                  : 0;
  if (length == 1) return static_cast<char32_t>(text[at++]);
  char32_t value = length == 0 ? kReplacement : first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if (byte(at + i) >> 6U != 2U) {
      ++at;
      return kReplacement;
    }
    value = value << 6U | (byte(at + i) & 0x3FU);
  }
  constexpr char32_t kMin[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_bad =
      length == 0 || value < kMin[length] || value > 0x10FFFF || (value >= 0xD800 && value < 0xE000);
  at += is_bad ? 1 : length;
  return is_bad ? kReplacement : value;
}

void appendCharacter(std::string& text, char32_t c) {
  const auto put = [&](char32_t byte) { text += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | c >> 6U);
    put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | c >> 12U);
    put(0x80 | (c >> 6U & 0x3F));
    put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | c >> 18U);
    put(0x80 | (c >> 12U & 0x3F));
    put(0x80 | (c >> 6U & 0x3F));
    put(0x80 | (c & 0x3F));
  }
}

/// Controls of ASCII and Latin-1, and the line ends of Unicode.
bool isControl(char32_t c) { return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x2028 || c == 0x2029; }

/// Blanks of any script.
bool isBlank(char32_t c) {
  return c == U' ' || c == 0xA0 || c == 0x1680 || (c >= 0x2000 && c <= 0x200B) || c == 0x202F ||
         c == 0x205F || c == 0x3000;
}

}  // namespace

std::string validUtf8(std::string_view text) {
  std::string valid;
  for (std::size_t at = 0; at < text.size();) appendCharacter(valid, nextCharacter(text, at));
  return valid;
}

std::string safeFileName(std::uint32_t region, std::string_view name) {
  constexpr std::size_t kLongest = 80;
  constexpr std::u32string_view kForbidden = U"/\\:*?\"'<>|$`&;!%{}[]()#~\uFFFD\uFEFF";
  constexpr std::string_view kDropped = " .";  // at the end, for Windows
  name = name.substr(0, name.find_last_not_of(kDropped) + 1);
  name.remove_prefix(std::min(name.find_first_not_of(' '), name.size()));
  std::string safe;
  for (std::size_t at = 0; at < name.size();) {
    const char32_t c = nextCharacter(name, at);
    const bool is_bad = isControl(c) || isBlank(c) || kForbidden.find(c) != std::u32string_view::npos;
    std::string next;
    appendCharacter(next, is_bad ? U'_' : c);
    if (safe.size() + next.size() > kLongest) break;
    safe += next;
  }
  safe.resize(safe.find_last_not_of(kDropped) + 1);
  return fmt::format("{:06}{}{}", region, safe.empty() ? "" : "_", safe);
}

std::string onOneLine(std::string_view text) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t c = nextCharacter(text, at);
    appendCharacter(line, isControl(c) ? U' ' : c);
  }
  return line;
}

std::string yamlQuoted(std::string_view text) {
  std::string quoted = "\"";
  for (std::size_t at = 0; at < text.size();) {
    const char32_t c = nextCharacter(text, at);
    const auto code = static_cast<std::uint32_t>(c);
    if (c == U'"' || c == U'\\') quoted += '\\';
    if (isControl(c) || c == 0xFEFF || c == 0xFFFE || c == 0xFFFF) {
      quoted += fmt::format("\\u{:04X}", code);
    } else {
      appendCharacter(quoted, c);
    }
  }
  return quoted + '"';
}

std::string xmlEscaped(std::string_view text) {
  std::string escaped;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t c = nextCharacter(text, at);
    constexpr std::u32string_view kMarkup = U"&<>\"'", kLineEnds = U"\n\r\t\u0085\u2028";
    const bool is_invalid = c < 0x20 || c == 0xFFFE || c == 0xFFFF;
    if (kMarkup.find(c) != std::u32string_view::npos || kLineEnds.find(c) != std::u32string_view::npos) {
      escaped += fmt::format("&#{};", static_cast<std::uint32_t>(c));
    } else {
      appendCharacter(escaped, is_invalid ? kReplacement : c);
    }
  }
  return escaped;
}

std::string jsonText(const ExportJson& json, int indent) {
  return json.dump(indent, ' ', false, ExportJson::error_handler_t::replace) + "\n";
}

std::string jsonByLines(const ExportJson& object) {
  std::string text = "{\n";
  const char* separator = "";
  for (const auto& [key, value] : object.items()) {
    text += separator;
    text += ExportJson(key).dump(-1, ' ', false, ExportJson::error_handler_t::replace) + ": " +
            value.dump(-1, ' ', false, ExportJson::error_handler_t::replace);
    separator = ",\n";
  }
  return text + "\n}\n";
}

}  // namespace scantrove
