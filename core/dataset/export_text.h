#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace scantrove {

using ExportJson = nlohmann::ordered_json;

/// `text` as valid UTF-8: invalid bytes become U+FFFD.
[[nodiscard]] std::string validUtf8(std::string_view text);

/// "000012_red_cup" for the region 12 called "red cup": a file name for any system, which keeps letters of
/// all languages. Blanks, path separators, line ends and shell characters become '_'. No extension; at most
/// 80 bytes of the name. Regions of one name differ by their number.
[[nodiscard]] std::string safeFileName(std::uint32_t region, std::string_view name);

/// `text` on one line: line ends and control characters become blanks.
[[nodiscard]] std::string onOneLine(std::string_view text);

/// `text` as a double-quoted scalar of YAML 1.1 and 1.2.
[[nodiscard]] std::string yamlQuoted(std::string_view text);

/// `text` for XML 1.0, between tags or within quotes. Line ends and tabs stay (as character references);
/// other control characters, which XML cannot hold, become U+FFFD.
[[nodiscard]] std::string xmlEscaped(std::string_view text);

/// JSON as a text file, with lists of numbers on one line if `indent` is -1.
[[nodiscard]] std::string jsonText(const ExportJson& json, int indent = 1);

/// `{"<key>": ..., ...}` with one line for each member: compact but readable.
[[nodiscard]] std::string jsonByLines(const ExportJson& object);

}  // namespace scantrove
