#pragma once
#include <CLI/CLI.hpp>

#include "app/command_job.h"

namespace scantrove {

/// Adds `project scan`; `parent` is the `project` command.
void addProjectScan(CLI::App& parent, CommandJob& job);

}  // namespace scantrove
