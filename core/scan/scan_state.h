#pragma once

namespace scantrove {

/// States of a ScanWorker.
/// `finishing`: no more frames come, at the end of the source or because a user stopped; `refining`:
/// refinement runs; `finished`: the scan has ended, and its session may be open for review.
enum class ScanState { idle, starting, scanning, paused, finishing, refining, finished, failed };

/// Whether the worker is busy: a scan runs, starts or ends.
[[nodiscard]] constexpr bool isBusy(ScanState state) {
  return state == ScanState::starting || state == ScanState::scanning || state == ScanState::paused ||
         state == ScanState::finishing || state == ScanState::refining;
}

/// All valid state changes. A scan goes from `starting` through `finishing` to its end, even when
/// interrupted; an opened session goes from `starting` to its end at once.
[[nodiscard]] constexpr bool canChange(ScanState from, ScanState to) {
  using enum ScanState;
  switch (from) {
    case idle:
      return to == starting;
    case starting:
      return to == scanning || to == paused || to == finishing || to == finished || to == failed;
    case scanning:
      return to == paused || to == finishing;
    case paused:
      return to == scanning || to == finishing;
    case finishing:
      return to == refining || to == finished || to == failed;
    case refining:
      return to == finishing || to == failed;
    case finished:
      return to == starting || to == failed;  // the review of its session may fail
    case failed:
      return to == starting;
  }
  return false;
}

}  // namespace scantrove
