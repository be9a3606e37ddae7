#pragma once
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/text.h"

namespace scantrove {

/// What the program returns: a promise to scripts.
enum ExitCode : int {
  kDone = 0,
  kJobFailed = 1,   ///< the world failed: one message on stderr
  kWrongUsage = 2,  ///< the command line was not understood
};

/// A name from a file or folder as a part of a line: no control characters, no line feeds.
[[nodiscard]] inline std::string inLine(std::string_view name) {
  std::string text = forTerminal(name);
  std::ranges::replace(text, '\n', '?');
  return text;
}

/// Where a command's callback leaves what the program returns.
struct CommandOutcome {
  int exit_code = kDone;

  /// Reports `error` on stderr, once, and makes the program return kJobFailed.
  void failWith(const Error& error) {
    std::cerr << "scantrove: " << forTerminal(error.message()) << '\n';
    exit_code = kJobFailed;
  }
};

/// Each adds one subcommand with its options; its callback does the work and fills `outcome`.
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
