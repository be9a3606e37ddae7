#pragma once
#include "app/command.h"

namespace scantrove {

/// `session refine`: the refinement of a scan that was skipped, or that broke off.
void addSessionRefine(CLI::App& parent, CommandOutcome& outcome);

}  // namespace scantrove
