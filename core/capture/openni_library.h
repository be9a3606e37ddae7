#pragma once
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Loads OpenNI2 and its drivers, once a process (they stay loaded until it ends); its own console log is
/// off. Any thread. Error: OpenNI2's words, and which package to install.
[[nodiscard]] Result<void> initializeOpenNi();

/// What OpenNI2 says about the last call that failed on this thread, in one line.
[[nodiscard]] std::string openNiError();

}  // namespace scantrove
