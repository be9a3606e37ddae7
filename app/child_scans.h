#pragma once
#include <functional>
#include <string>
#include <vector>

#include "app/recording_outcome.h"

namespace scantrove {

/// Scans every source in a process of its own (ChildScan), `at_once` at a time. `argumentsFor` gives the
/// arguments of the program for one source; `on_end` gets each outcome as it comes. A stop request (see
/// stop_signal.h) stops all processes, which write their results; a second one ends them at once. Result:
/// the outcomes in the order of `sources`. Main thread; blocks.
[[nodiscard]] std::vector<RecordingOutcome> runChildScans(
    const std::vector<std::string>& sources, int at_once,
    const std::function<std::vector<std::string>(const std::string& source)>& argumentsFor,
    const std::function<void(const RecordingOutcome&)>& on_end);

}  // namespace scantrove
