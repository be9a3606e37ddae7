#pragma once
#include "ui/main_window/window_options.h"

namespace scantrove {

/// Shows the window until it is closed. Result: the exit code; 1 if there is no display or the scan for a
/// screenshot failed.
int runWindow(int& argc, char** argv, const WindowOptions& options);

}  // namespace scantrove
