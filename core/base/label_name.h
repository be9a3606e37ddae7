#pragma once
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

inline constexpr int kLongestLabelName = 200;  ///< characters

/// Validates names of regions and objects: returns the UTF-8 name without surrounding blanks. Error: the name
/// is empty, longer than kLongestLabelName, not UTF-8, contains control characters, or is a number alone
/// (commands accept an id or a name).
[[nodiscard]] Result<std::string> checkedLabelName(std::string_view name);

/// Validates categories likewise; these may be empty or a number.
[[nodiscard]] Result<std::string> checkedCategoryName(std::string_view category);

/// Validates names of projects likewise; these may be empty or a number.
[[nodiscard]] Result<std::string> checkedProjectName(std::string_view name);

}  // namespace scantrove
