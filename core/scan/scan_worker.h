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

/// Runs one scan after the other on a thread that owns device and pipeline. Commands go in, snapshots and
/// events come out. All public functions are for any thread; only wait() waits for a frame.
class ScanWorker {
 public:
  /// `niceness`: of the worker, and of the device's threads where they are the processor's.
  explicit ScanWorker(ScanListener listener, Niceness niceness = Niceness::none);
  ~ScanWorker();  ///< closes the scan and waits for that
  ScanWorker(const ScanWorker&) = delete;
  ScanWorker& operator=(const ScanWorker&) = delete;

  /// Of several ShowKeyFrame, SetParams, FollowCatalogue, or exports of one kind, that wait only the newest
  /// is done.
  void post(ScanCommand command);
  void wait();  ///< until the scan that was started last has ended; its review may be open
  [[nodiscard]] ScanState state() const { return state_; }
  [[nodiscard]] LatestValue<ScanSnapshot>& snapshots() { return snapshots_; }

 private:
  /// What commands have set for the present scan.
  struct Control {
    bool is_paused = false;
    int steps = 0;
    bool is_stopped = false, is_closed = false;
    bool skips_refinement = false;
  };
  /// What commands have changed of the frame that is shown.
  struct Changes {
    bool catalogue = false, params = false, regions = false;
  };
  /// What a command is for; both null: nothing is open.
  struct Target {
    ScanRun* run = nullptr;
    ScanReview* review = nullptr;
  };

  void loop(const std::stop_token& token);
  /// Does one command. Error: scan or review cannot go on.
  [[nodiscard]] Result<void> execute(const ScanCommand& command, Target target);
  /// The next command for the present scan, or none. StartScan stays in the queue.
  [[nodiscard]] std::optional<ScanCommand> take();
  /// The same, after waiting for it. None: another scan is to start.
  [[nodiscard]] std::optional<ScanCommand> awaitCommand();
  template <class Command>
  [[nodiscard]] bool isPosted() const;  // mutex_ is held

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
  /// Keeps the session of `request` open until something else is asked for.
  void review(const ScanRequest& request, bool is_after_scan);

  /// All changes of state.
  void enter(ScanState next);
  void failWith(const Error& error);

  const ScanListener listener_;
  std::atomic<ScanState> state_{ScanState::idle};
  LatestValue<ScanSnapshot> snapshots_;

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<ScanCommand> queue_;
  bool is_running_ = false;       // what wait() waits for
  std::stop_source export_stop_;  // of the export that was posted last

  // The worker's thread's alone.
  Control control_;
  Changes changes_;
  ScanParams params_;  // as they were set last

  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace scantrove
