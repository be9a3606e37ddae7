#include "core/capture/json_file.h"

#include <algorithm>

#include "core/base/text_file.h"

namespace scantrove {

namespace {

/// Ten times the values of the longest recordings. A parsed value takes up to a hundred bytes.
constexpr std::ptrdiff_t kMostJsonValues = 20'000'000;

/// At least the number of values: each but the first follows a comma or a bracket.
std::ptrdiff_t mostValuesIn(std::string_view text) {
  return std::ranges::count_if(text, [](char c) { return c == ',' || c == '[' || c == '{'; });
}

}  // namespace

Result<nlohmann::json> parseJson(std::string_view text, const std::string& name) {
  if (mostValuesIn(text) > kMostJsonValues)
    return fail(name + " holds more than 20 million values: too many for a recording.",
                "Split the recording into shorter ones.");
  nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_discarded()) return json;
  return fail(name + " is no JSON, or it is truncated.", "Correct it, or export or download it again.");
}

Result<nlohmann::json> readJson(const std::filesystem::path& file) {
  const auto text = readTextFile(file);
  return text ? parseJson(*text, file.string()) : fail(text.error());
}

}  // namespace scantrove
