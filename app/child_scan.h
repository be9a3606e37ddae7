#pragma once
#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/recording_outcome.h"
#include "core/base/result.h"

namespace scantrove {

/// A process of this program that scans one recording with `project scan --json`. Its messages go to stderr,
/// each line after the recording's name. It ends with this process: then it stops as on SIGTERM and writes
/// its results. Main thread.
class ChildScan {
 public:
  /// `arguments`: those of the program, without its name. Error: the system starts no more processes.
  [[nodiscard]] static Result<std::unique_ptr<ChildScan>> start(std::string source,
                                                                const std::vector<std::string>& arguments);
  ChildScan(const ChildScan&) = delete;
  ChildScan& operator=(const ChildScan&) = delete;
  /// Stops a process that still runs, and waits for it.
  ~ChildScan();

  /// Descriptors that poll(2) may wait for; -1: closed.
  [[nodiscard]] int out() const { return out_; }
  [[nodiscard]] int err() const { return err_; }
  /// Takes what the process wrote so far, without waiting.
  void read();
  /// As Ctrl+C: the first stops the scan, the second ends it at once.
  void interrupt();
  /// The outcome once the process has ended.
  [[nodiscard]] std::optional<RecordingOutcome> outcome();

 private:
  explicit ChildScan(std::string source) : source_(std::move(source)) {}
  void showLines(bool all);
  void show(const std::string& line) const;
  [[nodiscard]] RecordingOutcome outcomeOf(int status) const;

  std::string source_;
  pid_t process_ = -1;
  int out_ = -1, err_ = -1;
  std::string answer_;      // from stdout
  std::string messages_;    // from stderr, not shown yet
  std::string error_line_;  // the last one that may be the reason of a failure; not shown yet
  bool is_interrupted_ = false;
};

}  // namespace scantrove
