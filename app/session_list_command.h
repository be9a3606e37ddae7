#pragma once
#include <vector>

#include "app/command.h"
#include "app/json_output.h"
#include "core/session/session_list.h"

namespace scantrove {

/// Adds `session list`; `parent` is the `session` command.
void addSessionList(CLI::App& parent, CommandJob& job);

/// The sessions as a JSON array, and as lines on stdout.
[[nodiscard]] Json toJson(const std::vector<SessionSummary>& sessions);
void printSessions(const std::vector<SessionSummary>& sessions);

}  // namespace scantrove
