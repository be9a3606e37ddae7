#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

/// Reads and parses a JSON file. Error: names the file; unreadable, or as of parseJson().
[[nodiscard]] Result<nlohmann::json> readJson(const std::filesystem::path& file);

/// Parses JSON. Error: names `name`; no JSON, or so many values that they would fill the memory.
[[nodiscard]] Result<nlohmann::json> parseJson(std::string_view text, const std::string& name);

}  // namespace scantrove
