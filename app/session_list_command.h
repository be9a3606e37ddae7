#pragma once
#include "app/command.h"

namespace scantrove {

/// Adds `session list`; `parent` is the `session` command.
void addSessionList(CLI::App& parent, CommandJob& job);

}  // namespace scantrove
