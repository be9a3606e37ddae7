#pragma once

namespace scantrove {

/// Turns the first Ctrl+C (SIGINT), SIGTERM or SIGHUP (the terminal was closed) into a request to stop; a
/// second one of its kind ends the program at once. A SIGHUP that is ignored already (nohup) stays so. From
/// then on nobody reading the output any more does not end the program either. The signal ends the program
/// itself where the request is not met within 4 s; while results are being written, within 20 s.
void listenForStop();

/// Whether a stop was requested since. Any thread.
[[nodiscard]] bool stopRequested();

/// A stop was requested by Ctrl+C, which a person may press once to end a camera's scan and once more to skip
/// what follows it. Any thread.
[[nodiscard]] bool isInterrupted();

/// The request is met, and there is something else to stop: waits for another one, as listenForStop() does.
void listenForStopAgain();

/// What is lost where the request is not met in time.
enum class AtStop {
  nothing,     ///< there are no results yet
  unfinished,  ///< what is on the disk by then stays
  results,     ///< they are being written
};
/// Any thread. AtStop::nothing at first.
void setAtStop(AtStop stage);

}  // namespace scantrove
