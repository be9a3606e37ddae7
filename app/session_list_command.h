#pragma once
#include "app/command.h"

namespace scantrove {

/// Adds `list` to the subcommand `parent` ("session"): the sessions in a folder.
void addSessionList(CLI::App& parent, CommandOutcome& outcome);

}  // namespace scantrove
