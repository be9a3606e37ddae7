#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace scantrove {

using ExportJson = nlohmann::ordered_json;

/// `text` as valid UTF-8: bytes that are none become U+FFFD.
[[nodiscard]] std::string validUtf8(std::string_view text);

/// "000012_red_cup" for the region 12 called "red cup": a file name on any system, letters of any language
/// kept; blanks and what separates folders, ends lines or has a meaning to a shell become '_'. No extension;
/// at most 80 bytes of the name. Regions of one name differ by their number.
[[nodiscard]] std::string safeFileName(std::uint32_t region, std::string_view name);

/// `text` on one line: line ends and control characters become blanks.
[[nodiscard]] std::string onOneLine(std::string_view text);

/// `text` as a double-quoted scalar of YAML 1.1 and 1.2.
[[nodiscard]] std::string yamlQuoted(std::string_view text);

/// JSON as a text file, lists of numbers on one line where `indent` is -1.
[[nodiscard]] std::string jsonText(const ExportJson& json, int indent = 1);

/// `{"<key>": ..., ...}` with one line for each member: large, and still to be read by people.
[[nodiscard]] std::string jsonByLines(const ExportJson& object);

}  // namespace scantrove
