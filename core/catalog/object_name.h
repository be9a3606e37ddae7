#pragma once
#include <QString>
#include <string>

#include "core/base/result.h"

namespace scantrove {

inline constexpr int kLongestObjectName = 200;  ///< characters

/// A name that a person gave, without the blanks around it. Error: empty, longer than kLongestObjectName,
/// with line breaks or other control characters, not UTF-8, or a number alone (commands take an id or a
/// name).
[[nodiscard]] Result<QString> checkedObjectName(const std::string& name);

}  // namespace scantrove
