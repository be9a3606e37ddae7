#pragma once

namespace scantrove {

/// Turns the first Ctrl+C (SIGINT), SIGTERM or SIGHUP (the terminal was closed) into a request to stop; a
/// second one of its kind ends the program at once. A SIGHUP that is ignored already (nohup) stays so. From
/// then on nobody reading the output any more does not end the program either.
void listenForStop();

/// Whether a stop was requested since. Any thread.
[[nodiscard]] bool stopRequested();

}  // namespace scantrove
