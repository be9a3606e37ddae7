#pragma once
#include <chrono>
#include <functional>
#include <string>

#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// Progress on stderr. On a terminal it rewrites one line; elsewhere it prints a line every 3 s. Use from one
/// thread.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();  ///< ends the open line of a terminal
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const ScanSnapshot& snapshot);
  /// Shows the text of `describe`, which is called only when the text is due.
  void show(const std::function<std::string()>& describe);
  /// Prints a message on its own line.
  void print(const std::string& message);

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
