#pragma once
#include <CLI/CLI.hpp>

namespace scantrove {

/// Makes every option of `app` and its commands refuse an empty argument (an unset variable in a script) and
/// one that is not UTF-8 (databases and results cannot store it). --name, --class and NAME may be empty;
/// SOURCE need not be UTF-8 because it is only read.
void refuseUnusableArguments(CLI::App& app);

}  // namespace scantrove
