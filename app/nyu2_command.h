#pragma once
#include "app/command.h"

namespace scantrove {

/// Adds `evaluate nyu2` to `evaluate`.
void addEvaluateNyu2(CLI::App& parent, CommandJob& job);

}  // namespace scantrove
