#pragma once
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/text.h"

namespace scantrove {

/// Exit codes of the program. Scripts rely on them.
enum ExitCode : int {
  kDone = 0,
  kJobFailed = 1,   ///< the command failed; one message on stderr
  kWrongUsage = 2,  ///< the command line is invalid
};

/// A name from a file or folder as part of one line: without control characters and line feeds.
[[nodiscard]] inline std::string inLine(std::string_view name) {
  std::string text = forTerminal(name);
  std::ranges::replace(text, '\n', '?');
  return text;
}

/// Receives the exit code from a command's callback.
struct CommandOutcome {
  int exit_code = kDone;

  /// Prints `error` on stderr and sets the exit code to kJobFailed.
  void failWith(const Error& error) {
    std::cerr << "scantrove: " << forTerminal(error.message()) << '\n';
    exit_code = kJobFailed;
  }
};

/// Each adds one subcommand. Its callback runs the command and fills `outcome`.
void addScanCommand(CLI::App& app, CommandOutcome& outcome);
void addSessionCommand(CLI::App& app, CommandOutcome& outcome);
void addExportCommand(CLI::App& app, CommandOutcome& outcome);
void addRecordCommand(CLI::App& app, CommandOutcome& outcome);
void addEvaluateCommand(CLI::App& app, CommandOutcome& outcome);
void addDevicesCommand(CLI::App& app, CommandOutcome& outcome);
void addParamsCommand(CLI::App& app, CommandOutcome& outcome);
void addObjectsCommand(CLI::App& app, CommandOutcome& outcome);
void addBenchCommand(CLI::App& app, CommandOutcome& outcome);

}  // namespace scantrove
