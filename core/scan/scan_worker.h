#pragma once
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "core/base/latest_value.h"
#include "core/base/result.h"
#include "core/base/thread_priority.h"
#include "core/scan/scan_command.h"
#include "core/scan/scan_event.h"
#include "core/scan/scan_snapshot.h"
#include "core/scan/scan_state.h"

namespace scantrove {

class ScanReview;
class ScanRun;

/// Runs scans one after the other on a thread that owns device and pipeline. It takes commands, and sends
/// snapshots and events. All public functions are for any thread; only wait() waits for frames.
class ScanWorker {
 public:
  /// `niceness`: of the worker, and of the device's threads if these run on the CPU.
  explicit ScanWorker(ScanListener listener, Niceness niceness = Niceness::none);
  ~ScanWorker();  ///< closes the scan and waits for that
  ScanWorker(const ScanWorker&) = delete;
  ScanWorker& operator=(const ScanWorker&) = delete;

  /// Of several waiting ShowKeyFrame, LabelKeyFrame, SetParams, ApplyCatalogueChanges, or exports of one
  /// kind, only the newest is executed.
  void post(ScanCommand command);
  void wait();  ///< until the last started scan has ended; its review may be open
  [[nodiscard]] ScanState state() const { return state_; }
  [[nodiscard]] LatestValue<ScanSnapshot>& snapshots() { return snapshots_; }

 private:
  /// Settings by commands for the current scan.
  struct Control {
    bool is_paused = false;
    int steps = 0;
    bool is_stopped = false, is_closed = false;
    bool skips_refinement = false;
  };
  /// Changes by commands to the displayed frame.
  struct Changes {
    bool catalogue = false, params = false, regions = false;
  };
  /// The target of a command; both null: nothing is open.
  struct Target {
    ScanRun* run = nullptr;
    ScanReview* review = nullptr;
  };

  void loop(const std::stop_token& token);
  /// Executes one command. Error: scan or review cannot continue.
  [[nodiscard]] Result<void> execute(const ScanCommand& command, Target target);
  /// The next command for the current scan, or none. StartScan stays in the queue.
  [[nodiscard]] std::optional<ScanCommand> take();
  /// The same, after waiting for one. None: another scan is to start.
  [[nodiscard]] std::optional<ScanCommand> awaitCommand();
  template <class Command>
  [[nodiscard]] bool isPosted() const;  // requires mutex_

  [[nodiscard]] std::stop_token exportStop();

  void run(const ScanRequest& request);
  /// False: it failed.
  [[nodiscard]] bool runScan(const ScanRequest& request);
  [[nodiscard]] Result<void> scanFrames(ScanRun& run);
  /// While paused, waits for a command.
  [[nodiscard]] Result<void> awaitTurn(ScanRun& run);
  [[nodiscard]] Result<void> showPaused(ScanRun& run);
  [[nodiscard]] bool isEnding();
  [[nodiscard]] bool isRefinementSkipped();
  /// Keeps the session of `request` open until another request arrives.
  void review(const ScanRequest& request, bool is_after_scan);

  /// All state changes.
  void enter(ScanState next);
  void failWith(const Error& error);

  const ScanListener listener_;
  std::atomic<ScanState> state_{ScanState::idle};
  LatestValue<ScanSnapshot> snapshots_;

  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::deque<ScanCommand> queue_;
  bool is_running_ = false;       // for wait()
  std::stop_source export_stop_;  // of the last posted export

  // Only for the worker's thread.
  Control control_;
  Changes changes_;
  ScanParams params_;  // as last set

  std::jthread thread_;  // last: uses all members above
};

}  // namespace scantrove
