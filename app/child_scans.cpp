#include "app/child_scans.h"

#include <poll.h>

#include <cstddef>
#include <iostream>
#include <memory>
#include <utility>

#include "app/child_scan.h"
#include "app/stop_signal.h"

namespace scantrove {
namespace {

struct RunningScan {
  std::size_t index = 0;  ///< of the source
  std::unique_ptr<ChildScan> process;
};

/// Waits until a process writes or ends its output, 100 ms at most.
void waitForOutput(const std::vector<RunningScan>& running) {
  constexpr int kLongest_ms = 100;
  std::vector<pollfd> descriptors;
  for (const RunningScan& scan : running) {
    for (const int descriptor : {scan.process->out(), scan.process->err()})
      if (descriptor >= 0) descriptors.push_back({descriptor, POLLIN, 0});
  }
  static_cast<void>(::poll(descriptors.data(), descriptors.size(), kLongest_ms));
}

}  // namespace

std::vector<RecordingOutcome> runChildScans(
    const std::vector<std::string>& sources, int at_once,
    const std::function<std::vector<std::string>(const std::string& source)>& argumentsFor,
    const std::function<void(const RecordingOutcome&)>& on_end) {
  listenForStop();
  std::vector<RecordingOutcome> outcomes(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) outcomes[i].source = sources[i];
  std::vector<RunningScan> running;
  std::size_t next = 0;
  bool is_stopping = false;
  const auto end = [&](std::size_t index, RecordingOutcome outcome) {
    on_end(outcome);
    outcomes[index] = std::move(outcome);
  };
  const auto startNext = [&] {
    const std::size_t index = next++;
    auto process = ChildScan::start(sources[index], argumentsFor(sources[index]));
    if (process) {
      running.push_back({index, std::move(*process)});
    } else {
      RecordingOutcome outcome = outcomes[index];
      outcome.kind = RecordingOutcome::Kind::failed;
      outcome.reason = process.error().message();
      end(index, std::move(outcome));
    }
  };
  while (true) {
    while (!is_stopping && next < sources.size() && running.size() < static_cast<std::size_t>(at_once))
      startNext();
    if (running.empty()) return outcomes;
    waitForOutput(running);
    if (stopRequested()) {
      std::cerr << (is_stopping
                        ? "Ending all scans at once.\n"
                        : "Stopping all scans; they write their results. Ctrl+C again ends them at once.\n");
      is_stopping = true;
      for (const RunningScan& scan : running) scan.process->interrupt();
      listenForStopAgain();  // the scans have limits of their own for their ends
    }
    std::erase_if(running, [&](const RunningScan& scan) {
      scan.process->read();
      std::optional<RecordingOutcome> outcome = scan.process->outcome();
      if (!outcome) return false;
      end(scan.index, std::move(*outcome));
      return true;
    });
  }
}

}  // namespace scantrove
