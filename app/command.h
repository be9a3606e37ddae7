#pragma once
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string>
#include <string_view>

#include "app/command_job.h"
#include "core/base/result.h"
#include "core/base/text.h"

namespace scantrove {

/// A name from a file or folder as part of one line: without control characters and line feeds.
[[nodiscard]] inline std::string inLine(std::string_view name) {
  std::string text = forTerminal(name);
  std::ranges::replace(text, '\n', '?');
  return text;
}

/// Each adds one subcommand. Its callback sets `job`, or throws CLI::ValidationError (wrong usage).
void addScanCommand(CLI::App& app, CommandJob& job);
void addSessionCommand(CLI::App& app, CommandJob& job);
void addExportCommand(CLI::App& app, CommandJob& job);
void addRecordCommand(CLI::App& app, CommandJob& job);
void addEvaluateCommand(CLI::App& app, CommandJob& job);
void addDevicesCommand(CLI::App& app, CommandJob& job);
void addParamsCommand(CLI::App& app, CommandJob& job);
void addProjectCommand(CLI::App& app, CommandJob& job);
void addObjectsCommand(CLI::App& app, CommandJob& job);
void addBenchCommand(CLI::App& app, CommandJob& job);
void addRenderCommand(CLI::App& app, CommandJob& job);
void addReferenceCommand(CLI::App& app, CommandJob& job);

}  // namespace scantrove
