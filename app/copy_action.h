#pragma once
#include "app/command.h"

namespace scantrove {

/// Adds `objects copy`, which copies a whole catalogue between files and servers.
void addCopyAction(CLI::App& objects, CommandJob& job);

}  // namespace scantrove
