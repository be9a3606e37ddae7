#pragma once
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Loads OpenNI2 and its drivers once a process, without its console log; they stay loaded until the process
/// ends. Any thread. Error: OpenNI2's message, and which package to install.
[[nodiscard]] Result<void> initializeOpenNi();

/// OpenNI2's message about the last failed call of this thread, in one line.
[[nodiscard]] std::string openNiError();

}  // namespace scantrove
