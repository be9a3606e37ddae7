#pragma once
#include <spdlog/spdlog.h>

namespace scantrove {

/// Sends spdlog's default logger to stderr (results own stdout) at the level of SCANTROVE_LOG
/// (trace, debug, info, warn, error, off; default warn).
void initializeLog();

}  // namespace scantrove
