#pragma once
#include <optional>
#include <string>

#include "app/command_job.h"
#include "ui/main_window/window_options.h"

namespace scantrove {

/// A parsed command line: an exit code with its output, a command, or the window.
struct CommandLine {
  /// Set for --help and --version (kDone) and for wrong usage (kWrongUsage): nothing else is to be done.
  std::optional<ExitCode> exit_code;
  std::string out, err;  ///< with `exit_code`: texts for stdout and stderr
  CommandJob job;        ///< empty: the window was requested
  WindowOptions window;
};

/// Checks all options and values, and reads the file of --config. Prints nothing and runs no command.
[[nodiscard]] CommandLine parseCommandLine(int argc, const char* const* argv);

}  // namespace scantrove
