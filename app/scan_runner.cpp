#include "app/scan_runner.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

#include "app/stop_signal.h"
#include "core/base/urgent_end.h"

namespace scantrove {
namespace {

/// Events from the worker for the main thread, in order, none lost.
class EventQueue {
 public:
  void push(const ScanEvent& event) {
    {
      const std::scoped_lock lock(mutex_);
      events_.push_back(event);
    }
    arrived_.notify_one();
  }

  /// The next event, or none after `patience`.
  std::optional<ScanEvent> pop(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, patience, [this] { return !events_.empty(); })) return std::nullopt;
    ScanEvent event = std::move(events_.front());
    events_.pop_front();
    return event;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<ScanEvent> events_;
};

}  // namespace

Result<ScanReport> runToEnd(ScanRequest request, const std::function<void(const ScanSnapshot&)>& watch) {
  constexpr std::chrono::milliseconds kPoll{20};
  EventQueue events;
  ProgressLine progress;
  bool is_stopping = false;  // a person wants it to
  bool is_ending = false;    // no further frames; results are written
  request.pictures = false;  // what is watched are numbers
  listenForStop();
  ScanSession session([&](const ScanEvent& event) { events.push(event); });
  session.start(std::move(request));
  const auto showLatest = [&] {
    if (const auto snapshot = session.snapshots().collect()) {
      if (snapshot->frames.done() > 0 && !is_ending) setAtStop(AtStop::unfinished);
      if (watch) watch(*snapshot);
      progress.show(*snapshot);
    }
  };
  while (true) {
    if (const auto event = events.pop(kPoll)) {
      if (const auto* failed = std::get_if<ScanFailed>(&*event)) return fail(failed->error);
      if (const auto* finished = std::get_if<ScanFinished>(&*event)) {
        showLatest();  // the last one was posted before this event
        return finished->report;
      }
      if (const auto* changed = std::get_if<StateChanged>(&*event);
          changed && changed->state == ScanState::stopping) {
        is_ending = true;
        setAtStop(AtStop::results);
      }
      if (std::holds_alternative<PreparingDevice>(*event)) progress.say("Preparing the processor (once).");
      if (const auto* again = std::get_if<LookingAgain>(&*event)) {
        progress.show([again] {
          return "looking again, " + std::to_string(again->done + 1) + " of " + std::to_string(again->steps);
        });
      }
      if (const auto* skipped = std::get_if<FrameSkipped>(&*event)) progress.say(skipped->error.message());
      if (const auto* failure = std::get_if<CatalogueFailed>(&*event)) progress.say(failure->error.message());
      if (const auto* failure = std::get_if<MapFailed>(&*event)) progress.say(failure->error.message());
      if (const auto* drifted = std::get_if<MapDrifted>(&*event)) progress.say(drifted->error.message());
    }
    showLatest();
    if (stopRequested() && !is_stopping) {
      is_stopping = true;
      progress.say("Stopping; writing what there is.");
      setEndUrgent(true);
      session.close();
    }
  }
}

}  // namespace scantrove
