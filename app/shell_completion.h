#pragma once
#include <string>

#include "app/command_reference.h"

namespace scantrove {

/// The completion of commands, options and their values for bash: a script to be sourced.
[[nodiscard]] std::string bashCompletion(const ReferenceCommand& program);

/// The same for zsh: the function `_scantrove`, a file of `fpath`.
[[nodiscard]] std::string zshCompletion(const ReferenceCommand& program);

}  // namespace scantrove
