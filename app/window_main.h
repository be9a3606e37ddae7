#pragma once
#include "ui/main_window/window_options.h"

namespace scantrove {

/// Shows the window and returns when it is closed: the process' exit code. 1 when there is no display, or
/// when the scan that a screenshot was asked of failed.
int runWindow(int& argc, char** argv, const WindowOptions& options);

}  // namespace scantrove
