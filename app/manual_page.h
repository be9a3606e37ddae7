#pragma once
#include <string>

#include "app/command_reference.h"

namespace scantrove {

/// The manual page of section 1 in roff: every command with its arguments and options. `version`: "0.1.0".
[[nodiscard]] std::string manualPage(const ReferenceCommand& program, const std::string& version);

}  // namespace scantrove
