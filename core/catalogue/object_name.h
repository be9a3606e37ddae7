#pragma once
#include <QString>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// The name as the catalogue stores it. Errors: see checkedLabelName.
[[nodiscard]] Result<QString> checkedObjectName(const std::string& name);

}  // namespace scantrove
