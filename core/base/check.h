#pragma once

namespace scantrove::detail {
[[noreturn]] void checkFailed(const char* condition, const char* file, int line);
}

/// Ends the program at a bug (a violated internal contract) and prints its location. Never for bad input.
#define SCANTROVE_CHECK(condition)                     \
  (static_cast<bool>(condition) ? static_cast<void>(0) \
                                : ::scantrove::detail::checkFailed(#condition, __FILE__, __LINE__))
