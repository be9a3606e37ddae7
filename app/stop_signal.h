#pragma once

namespace scantrove {

/// Turns the first Ctrl+C (SIGINT), SIGTERM or SIGHUP (closed terminal) into a stop request. A second signal
/// of the same kind ends the program at once. An ignored SIGHUP (nohup) stays ignored. SIGPIPE is ignored
/// from then on. If the program does not stop within 4 s (20 s while it writes results), the signal ends it.
void listenForStop();

/// Whether a stop was requested. Any thread.
[[nodiscard]] bool stopRequested();

/// Whether Ctrl+C requested the stop. The first ends the scan of a camera, the second skips its refinement.
/// Any thread.
[[nodiscard]] bool isInterrupted();

/// Clears the request and listens for the next one.
void listenForStopAgain();

/// What is lost if the program does not stop in time.
enum class AtStop {
  nothing,     ///< there are no results yet
  unfinished,  ///< data on the disk stays
  results,     ///< they are being written
  complete,    ///< nothing: the results are written
};
/// Any thread. AtStop::nothing at first. With AtStop::complete the program has 20 s from then on.
void setAtStop(AtStop stage);

}  // namespace scantrove
