#include "core/base/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>

#include <cstdlib>

namespace scantrove {

void initialiseLog() {
  auto logger = spdlog::get("scantrove");
  if (!logger) logger = spdlog::stderr_color_mt("scantrove");
  logger->set_pattern("scantrove: %^%l%$: %v");
  const char* level = std::getenv("SCANTROVE_LOG");
  logger->set_level(level ? spdlog::level::from_str(level) : spdlog::level::warn);
  spdlog::set_default_logger(logger);
}

}  // namespace scantrove
