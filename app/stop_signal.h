#pragma once

namespace scantrove {

/// Turns the first Ctrl+C (SIGINT) or SIGTERM into a request to stop; a second one ends the program at once.
void listenForStop();

/// Whether a stop was requested since. Any thread.
[[nodiscard]] bool stopRequested();

}  // namespace scantrove
