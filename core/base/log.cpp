#include "core/base/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include "core/base/text.h"

namespace scantrove {
namespace {

/// Messages contain file names, which may contain any bytes.
class MessageForTerminal : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string text = forTerminal({message.payload.data(), message.payload.size()});
    out.append(text.data(), text.data() + text.size());
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<MessageForTerminal>();
  }
};

}  // namespace

void initializeLog() {
  auto logger = spdlog::get("scantrove");
  if (!logger) logger = spdlog::stderr_color_mt("scantrove");
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<MessageForTerminal>('*').set_pattern("scantrove: %^%l%$: %*");
  logger->set_formatter(std::move(formatter));
  const char* level = std::getenv("SCANTROVE_LOG");
  logger->set_level(level ? spdlog::level::from_str(level) : spdlog::level::warn);
  spdlog::set_default_logger(logger);
}

}  // namespace scantrove
