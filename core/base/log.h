#pragma once
#include <spdlog/spdlog.h>

namespace scantrove {

/// Sets spdlog's default logger to stderr (stdout is for results) and the level of SCANTROVE_LOG (trace,
/// debug, info, warn, error, off; default warn).
void initializeLog();

}  // namespace scantrove
