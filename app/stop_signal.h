#pragma once

namespace scantrove {

/// Turns the first Ctrl+C (SIGINT), SIGTERM or SIGHUP (the terminal was closed) into a request to stop; a
/// second one of its kind ends the program at once. A SIGHUP that is ignored already (nohup) stays so. From
/// then on nobody reading the output any more does not end the program either. The signal ends the program
/// itself where the request is not met within 4 s; while results are being written, within 20 s.
void listenForStop();

/// Whether a stop was requested since. Any thread.
[[nodiscard]] bool stopRequested();

/// What is lost where the request is not met in time.
enum class AtStop {
  nothing,     ///< there are no results yet
  unfinished,  ///< what is on the disk by then stays
  results,     ///< they are being written
};
/// Any thread. AtStop::nothing at first.
void setAtStop(AtStop stage);

}  // namespace scantrove
