#pragma once

namespace scantrove {

/// States of a ScanWorker.
/// `finishing`: no more frames come, by themselves or because a person stopped; `refining`: Refinement runs;
/// `finished`: the scan has ended, and its session may be open for review.
enum class ScanState { idle, starting, scanning, paused, finishing, refining, finished, failed };

/// A scan that runs, or begins or ends, keeps its worker busy.
[[nodiscard]] constexpr bool isBusy(ScanState state) {
  return state == ScanState::starting || state == ScanState::scanning || state == ScanState::paused ||
         state == ScanState::finishing || state == ScanState::refining;
}

/// All changes of state that there are. A scan goes from `starting` over `finishing` to its end, even when
/// it breaks off; a session that is opened goes from `starting` to its end at once.
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
