#pragma once
#include <functional>

#include "core/base/result.h"

namespace scantrove {

/// Exit codes of the program. Scripts rely on them.
enum ExitCode : int {
  kDone = 0,
  kJobFailed = 1,   ///< the command failed; one message on stderr
  kWrongUsage = 2,  ///< the command line is invalid
};

/// Runs a command with its parsed arguments. Error: the message for stderr; the exit code is kJobFailed.
using CommandJob = std::function<Result<void>()>;

}  // namespace scantrove
