#pragma once
#include <chrono>
#include <functional>
#include <string>

#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// Progress on stderr: one line rewritten in place on a terminal, a new line every few seconds elsewhere. One
/// thread.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();  ///< leaves the terminal at the start of a fresh line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const ScanSnapshot& snapshot);
  /// The same with words of one's own, asked for only when they are shown.
  void show(const std::function<std::string()>& describe);
  /// A message of its own line, between two states of the progress.
  void say(const std::string& message);

 private:
  using Clock = std::chrono::steady_clock;
  void clearLine();

  bool is_terminal_;
  bool line_is_open_ = false;
  Clock::time_point next_;
};

/// "120/500 frames (24 %), 7.1 fps, tracking, 12 regions, 3 lost".
[[nodiscard]] std::string describeProgress(const ScanSnapshot& snapshot);

}  // namespace scantrove
