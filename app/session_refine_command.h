#pragma once
#include "app/command.h"

namespace scantrove {

/// Adds `session refine`, which does a refinement that was skipped or interrupted.
void addSessionRefine(CLI::App& parent, CommandJob& job);

}  // namespace scantrove
