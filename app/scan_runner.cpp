#include "app/scan_runner.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

#include "app/stop_signal.h"
#include "core/base/urgent_end.h"
#include "core/capture/open_input.h"
#include "core/scan/scan_worker.h"

namespace scantrove {
namespace {

/// Queue of events from the worker to the main thread.
class EventQueue {
 public:
  void push(const ScanEvent& event) {
    {
      const std::scoped_lock lock(mutex_);
      events_.push_back(event);
    }
    arrived_.notify_one();
  }

  /// The next event, or none after `timeout`.
  std::optional<ScanEvent> pop(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, timeout, [this] { return !events_.empty(); })) return std::nullopt;
    ScanEvent event = std::move(events_.front());
    events_.pop_front();
    return event;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<ScanEvent> events_;
};

/// Runs a scan, handles its events on the main thread and stops it on signals.
class Runner {
 public:
  explicit Runner(const std::function<void(const ScanSnapshot&)>& watch)
      : watch_(watch), worker_([this](const ScanEvent& event) { events_.push(event); }) {}

  Result<ScanReport> run(ScanRequest request) {
    constexpr std::chrono::milliseconds kPoll{20};
    if (request.refine_session) setAtStop(AtStop::unfinished);  // the scan is stored already
    is_live_ = isCameraName(request.source);
    worker_.post(StartScan{std::move(request)});
    while (true) {
      if (const auto event = events_.pop(kPoll)) {
        if (const auto* failed = std::get_if<ScanFailed>(&*event)) return fail(failed->error);
        if (const auto* finished = std::get_if<ScanFinished>(&*event)) {
          showLatest();  // the last snapshot was posted before this event
          setAtStop(AtStop::complete);
          return finished->report;
        }
        show(*event);
      }
      showLatest();
      if (stopRequested()) stop();
    }
  }

 private:
  void show(const ScanEvent& event) {
    if (std::holds_alternative<PreparingDevice>(event))
      progress_.print("Preparing the OpenCL device (once).");
    if (const auto* state = std::get_if<StateChanged>(&event)) enter(state->state);
    if (const auto* refined = std::get_if<RefinementStepped>(&event)) showRefinement(*refined);
    if (const auto* skipped = std::get_if<FrameSkipped>(&event)) progress_.print(skipped->error.message());
    if (const auto* failure = std::get_if<CatalogueFailed>(&event)) progress_.print(failure->error.message());
    if (const auto* failure = std::get_if<MapFailed>(&event)) progress_.print(failure->error.message());
    if (const auto* lost = std::get_if<CameraLost>(&event)) progress_.print(lost->error.message());
    if (const auto* returned = std::get_if<CameraReturned>(&event))
      progress_.print(returned->error.message());
    if (const auto* drifted = std::get_if<MapDrifted>(&event)) progress_.print(drifted->error.message());
    const auto* advice = std::get_if<ScanAdvice>(&event);
    if (advice != nullptr && !advice->proposed_units_per_meter) progress_.print(advice->error.message());
  }

  void enter(ScanState state) {
    state_ = state;
    if (state == ScanState::finishing) setAtStop(AtStop::results);
    if (state != ScanState::refining) return;
    if (is_stopping_) listenForStopAgain();
    is_stopping_ = false;
  }

  void showRefinement(const RefinementStepped& refined) {
    if (refined.done == 0 && refined.keyFrame() == 1 && !is_refining_) {
      is_refining_ = true;
      progress_.print("Refining objects with " + std::to_string(refined.key_frames) +
                      " key frames; Ctrl+C skips the rest.");
    }
    progress_.show([&refined] {
      return "refining objects: key frame " + std::to_string(refined.keyFrame()) + " of " +
             std::to_string(refined.key_frames);
    });
  }

  void showLatest() {
    const auto snapshot = worker_.snapshots().collect();
    if (!snapshot) return;
    const bool is_ending = state_ == ScanState::finishing || state_ == ScanState::refining;
    if (snapshot->frames.done() > 0 && !is_ending) setAtStop(AtStop::unfinished);
    if (watch_) watch_(*snapshot);
    progress_.show(*snapshot);
  }

  void stop() {
    if (is_stopping_) return;
    is_stopping_ = true;
    if (state_ == ScanState::refining) {
      progress_.print("Skipping the rest of the refinement and writing the results.");
      setEndUrgent(true);
      return worker_.post(SkipRefinement{});
    }
    // Users end the scan of a camera with Ctrl+C.
    if (isInterrupted() && is_live_) {
      progress_.print("Stopping; Ctrl+C again skips the refinement.");
      return worker_.post(StopScan{});
    }
    progress_.print("Stopping and writing the results.");
    setEndUrgent(true);
    worker_.post(CloseScan{});  // without a refinement
  }

  const std::function<void(const ScanSnapshot&)>& watch_;
  EventQueue events_;
  ProgressLine progress_;
  ScanState state_ = ScanState::idle;
  bool is_live_ = false;
  bool is_refining_ = false;
  bool is_stopping_ = false;
  ScanWorker worker_;  // last member: its thread ends before the others are destroyed
};

}  // namespace

Result<ScanReport> runToEnd(ScanRequest request, const std::function<void(const ScanSnapshot&)>& watch) {
  request.pictures = false;  // `watch` gets no images
  listenForStop();
  return Runner(watch).run(std::move(request));
}

}  // namespace scantrove
