#pragma once
#include <CLI/CLI.hpp>

namespace scantrove {

/// Makes every option of `app` and its commands refuse an empty argument, as an unset variable of a script
/// gives it, and one that is not UTF-8, as databases and results cannot keep it. Exceptions: texts that a
/// person may empty
/// (--name, --class, NAME), and SOURCE, which is only read.
void refuseUnusableArguments(CLI::App& app);

}  // namespace scantrove
