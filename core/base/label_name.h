#pragma once
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

inline constexpr int kLongestLabelName = 200;  ///< characters

/// The one rule for names of regions and objects: returns the UTF-8 name without surrounding blanks.
/// Error: the name is empty, longer than kLongestLabelName, not UTF-8, a number alone (commands take an id or
/// a name), or contains control characters.
[[nodiscard]] Result<std::string> checkedLabelName(std::string_view name);

/// The same rule for categories, which may be empty or a number.
[[nodiscard]] Result<std::string> checkedCategoryName(std::string_view category);

}  // namespace scantrove
