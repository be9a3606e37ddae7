#pragma once

namespace scantrove {

/// Turns the first Ctrl+C (SIGINT), SIGTERM or SIGHUP (the terminal was closed) into a request to stop; a
/// second one of its kind ends the program at once. A SIGHUP that is ignored already (nohup) stays so. From
/// then on nobody reading the output any more does not end the program either. The signal ends the program
/// itself where the request is not met within 4 s, unless there are results to write.
void listenForStop();

/// Whether a stop was requested since. Any thread.
[[nodiscard]] bool stopRequested();

/// Whether an orderly stop has results to write, and so takes the time that it needs. Any thread.
void keepResultsAtStop(bool has_results);

}  // namespace scantrove
